// Sanitizer settings for the Vulkan driver and the validation layer, which are not instrumented. Compiled into each
// test program that opens a GPU, with exported symbols (-rdynamic).

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define GEARSHIFT_ASAN
#endif
#endif
#if defined(__SANITIZE_ADDRESS__)
#define GEARSHIFT_ASAN
#endif

#if defined(GEARSHIFT_ASAN) || defined(__SANITIZE_THREAD__)
// Overrides dlclose() to keep all libraries loaded. The sanitizers can then name these libraries in reports of leaks
// and races, so that the suppressions below match.
extern "C" int dlclose(void*) {
  return 0;
}
#endif

#if defined(GEARSHIFT_ASAN)
extern "C" const char* __lsan_default_options() {
  return "print_suppressions=0";
}
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libvulkan_lvp.so\n"
         "leak:libLLVM\n"
         "leak:libVkLayer_khronos_validation.so\n"
         "leak:libvulkan.so\n"
         "leak:libopenxr_loader.so\n";
}
#endif

#if defined(__SANITIZE_THREAD__)
extern "C" const char* __tsan_default_options() {
  return "ignore_noninstrumented_modules=1";
}
extern "C" const char* __tsan_default_suppressions() {
  return "race:libvulkan_lvp.so\n"
         "race:libVkLayer_khronos_validation.so\n"
         "race:libLLVM\n";
}
#endif
