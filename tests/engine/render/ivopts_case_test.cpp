// The minimal case of a wrong-code bug in g++ 12.2 -O2 (Debian 12): stores are lost when a function that returns a
// matrix is inlined into a loop like the one in set_views(), and every frame is black. The code is correct at -O1 and
// -O3, with -fno-ivopts, and with clang. The engine and its tests are compiled with -fno-ivopts; without it, this test
// and 30 others of the renderer fail.
#include <cstddef>

#include <doctest/doctest.h>

// The namespace needs a name: in an unnamed namespace, g++ inlines all functions with a single caller at once, and the
// bug does not appear.
namespace ivopts_case {

struct Vec3 {
  float x, y, z;
};
struct Vec4 {
  float x, y, z, w;
};
struct Mat4 {
  Vec4 c[4];
  Vec4& operator[](int i) { return c[i]; }
  const Vec4& operator[](int i) const { return c[i]; }
};
struct EyeView {
  Mat4 world, clip;
  Vec3 eye;
};
struct Uniforms {
  Mat4 clip[2];
  Vec4 eye[2], right[2];
};
struct Pass {
  const EyeView* views;
  std::size_t count;
  Uniforms uniforms;
};

Mat4 operator*(const Mat4& m, const Mat4& n) {
  const Vec4 a = m[0], b = m[1], c = m[2], d = m[3];
  Mat4 r{};
  for (int i = 0; i < 4; ++i) {
    const Vec4 q = n[i];
    r[i] = {a.x * q.x + b.x * q.y + c.x * q.z + d.x * q.w, a.y * q.x + b.y * q.y + c.y * q.z + d.y * q.w,
            a.z * q.x + b.z * q.y + c.z * q.z + d.z * q.w, a.w * q.x + b.w * q.y + c.w * q.z + d.w * q.w};
  }
  return r;
}

Mat4 clip_of(const EyeView& view) {
  return view.clip * view.world;
}

void fill(Uniforms& uniforms, const EyeView* views, std::size_t count) {
  for (std::size_t e = 0; e < count; ++e) {
    const Mat4& clip = views[e].clip;
    const Vec3 right{views[e].world[0].x, views[e].world[1].x, views[e].world[2].x};
    uniforms.clip[e] = clip_of(views[e]);
    uniforms.eye[e] = {views[e].eye.x, views[e].eye.y, views[e].eye.z, 1.0f};
    uniforms.right[e] = {right.x / clip[0].x, right.y / clip[0].x, right.z / clip[0].x, 0.0f};
  }
}

[[gnu::noinline]] void prepare(Pass& pass, Uniforms* written) {
  fill(pass.uniforms, pass.views, pass.count);
  *written = pass.uniforms;
}

}  // namespace ivopts_case

TEST_CASE("uniforms that are filled in an inlined loop keep every store") {
  using namespace ivopts_case;
  const Mat4 identity{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
  const EyeView views[] = {{identity, identity, {1, 2, 3}}, {identity, identity, {4, 5, 6}}};
  for (std::size_t count = 1; count <= 2; ++count) {
    Pass pass{views, count, {}};
    Uniforms written{};
    prepare(pass, &written);
    CHECK(written.clip[count - 1][0].x == 1.0f);
    CHECK(written.eye[count - 1].x == views[count - 1].eye.x);
    CHECK(written.right[count - 1].x == 1.0f);
  }
}
