// Draws a Dear ImGui frame on the CPU, triangle by triangle: the reference for our pipelines.
#pragma once

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/image/image.h"

namespace gearshift::test {

class UiRaster {
 public:
  // Starts with a picture of the frame's size in one colour.
  UiRaster(const ImDrawData& data, std::array<int, 3> background) : data_(data) {
    picture_.width = static_cast<int>(data.DisplaySize.x);
    picture_.height = static_cast<int>(data.DisplaySize.y);
    picture_.rgba.resize(4 * static_cast<std::size_t>(picture_.width) * static_cast<std::size_t>(picture_.height), 255);
    for (std::size_t i = 0; i < picture_.rgba.size(); i += 4) {
      for (std::size_t c = 0; c < 3; ++c) picture_.rgba[i + c] = static_cast<std::uint8_t>(background[c]);
    }
    ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&coverage_, &coverage_width_, &coverage_height_);
  }

  engine::Image draw() {
    for (int l = 0; l < data_.CmdListsCount; ++l) {
      const ImDrawList& list = *data_.CmdLists[l];
      for (const ImDrawCmd& command : list.CmdBuffer) {
        for (unsigned i = 0; i + 2 < command.ElemCount; i += 3) {
          const auto vertex = [&](unsigned k) -> const ImDrawVert& {
            const ImDrawIdx index = list.IdxBuffer[static_cast<int>(command.IdxOffset + i + k)];
            return list.VtxBuffer[static_cast<int>(command.VtxOffset + index)];
          };
          triangle(vertex(0), vertex(1), vertex(2), command.ClipRect);
        }
      }
    }
    return picture_;
  }

 private:
  static double edge(ImVec2 a, ImVec2 b, double x, double y) {
    return static_cast<double>(b.x - a.x) * (y - static_cast<double>(a.y)) -
           static_cast<double>(b.y - a.y) * (x - static_cast<double>(a.x));
  }
  // Top-left rule: assigns a pixel on a shared edge to one of the two triangles.
  static bool owns(ImVec2 a, ImVec2 b) { return (a.y == b.y && b.x > a.x) || b.y < a.y; }

  double texel(int x, int y) const {
    x = std::clamp(x, 0, coverage_width_ - 1);
    y = std::clamp(y, 0, coverage_height_ - 1);
    return coverage_[y * coverage_width_ + x] / 255.0;
  }
  double coverage(double u, double v) const {
    const double x = u * coverage_width_ - 0.5, y = v * coverage_height_ - 0.5;
    const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
    const double s = x - i, t = y - j;
    return (1 - t) * ((1 - s) * texel(i, j) + s * texel(i + 1, j)) +
           t * ((1 - s) * texel(i, j + 1) + s * texel(i + 1, j + 1));
  }

  void triangle(const ImDrawVert& a, const ImDrawVert& b0, const ImDrawVert& c0, const ImVec4& clip) {
    double area = edge(a.pos, b0.pos, static_cast<double>(c0.pos.x), static_cast<double>(c0.pos.y));
    if (area == 0.0) return;
    const ImDrawVert &b = area > 0 ? b0 : c0, &c = area > 0 ? c0 : b0;
    area = std::abs(area);
    const auto low = [](float edge_of_clip, float p, float q, float r) {
      return std::max(static_cast<int>(std::lround(edge_of_clip)), static_cast<int>(std::floor(std::min({p, q, r}))));
    };
    const auto high = [](float edge_of_clip, float p, float q, float r) {
      return std::min(static_cast<int>(std::lround(edge_of_clip)), static_cast<int>(std::ceil(std::max({p, q, r}))));
    };
    const int left = std::max(0, low(clip.x, a.pos.x, b.pos.x, c.pos.x));
    const int right = std::min(picture_.width, high(clip.z, a.pos.x, b.pos.x, c.pos.x));
    const int top = std::max(0, low(clip.y, a.pos.y, b.pos.y, c.pos.y));
    const int bottom = std::min(picture_.height, high(clip.w, a.pos.y, b.pos.y, c.pos.y));
    for (int y = top; y < bottom; ++y) {
      for (int x = left; x < right; ++x) {
        const double px = x + 0.5, py = y + 0.5;
        const double wa = edge(b.pos, c.pos, px, py), wb = edge(c.pos, a.pos, px, py), wc = edge(a.pos, b.pos, px, py);
        if (wa < 0 || wb < 0 || wc < 0) continue;
        if ((wa == 0 && !owns(b.pos, c.pos)) || (wb == 0 && !owns(c.pos, a.pos)) || (wc == 0 && !owns(a.pos, b.pos)))
          continue;
        blend(x, y, a, b, c, {wa / area, wb / area, wc / area});
      }
    }
  }

  void blend(int x, int y, const ImDrawVert& a, const ImDrawVert& b, const ImDrawVert& c, std::array<double, 3> w) {
    const auto mix = [&](double p, double q, double r) { return w[0] * p + w[1] * q + w[2] * r; };
    const auto channel = [&](int shift) {
      return mix((a.col >> shift) & 255u, (b.col >> shift) & 255u, (c.col >> shift) & 255u);
    };
    const double u = mix(static_cast<double>(a.uv.x), static_cast<double>(b.uv.x), static_cast<double>(c.uv.x));
    const double v = mix(static_cast<double>(a.uv.y), static_cast<double>(b.uv.y), static_cast<double>(c.uv.y));
    const double alpha = channel(IM_COL32_A_SHIFT) / 255.0 * coverage(u, v);
    std::uint8_t* pixel = picture_.pixel(x, y);
    const std::array<int, 3> shifts{IM_COL32_R_SHIFT, IM_COL32_G_SHIFT, IM_COL32_B_SHIFT};
    for (std::size_t i = 0; i < 3; ++i)
      pixel[i] = static_cast<std::uint8_t>(std::lround(alpha * channel(shifts[i]) + (1.0 - alpha) * pixel[i]));
  }

  const ImDrawData& data_;
  engine::Image picture_;
  unsigned char* coverage_ = nullptr;
  int coverage_width_ = 0, coverage_height_ = 0;
};

}  // namespace gearshift::test
