# A toolchain: the newest clang++ that is installed. .ci/install installs its sanitizers and its clang-tidy.
file(GLOB compilers /usr/bin/clang++-[0-9]*)
list(SORT compilers COMPARE NATURAL ORDER DESCENDING)
list(GET compilers 0 CMAKE_CXX_COMPILER)
