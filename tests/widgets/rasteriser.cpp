#include "widgets/rasteriser.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/glm.hpp>

namespace sward::editor {
namespace {

struct Texture {
  const unsigned char* alpha;
  int width, height;

  float texel(int x, int y) const {
    x = std::clamp(x, 0, width - 1);
    y = std::clamp(y, 0, height - 1);
    return static_cast<float>(alpha[y * width + x]) / 255.0f;
  }
  float sample(glm::vec2 uv) const {
    const float x = uv.x * static_cast<float>(width) - 0.5f, y = uv.y * static_cast<float>(height) - 0.5f;
    const int ix = static_cast<int>(std::floor(x)), iy = static_cast<int>(std::floor(y));
    const float fx = x - static_cast<float>(ix), fy = y - static_cast<float>(iy);
    return glm::mix(glm::mix(texel(ix, iy), texel(ix + 1, iy), fx),
                    glm::mix(texel(ix, iy + 1), texel(ix + 1, iy + 1), fx), fy);
  }
};

struct Corner {
  glm::vec2 at, uv;
  glm::vec4 colour;
};

Corner corner(const ImDrawVert& v) {
  const ImVec4 c = ImGui::ColorConvertU32ToFloat4(v.col);
  return {{v.pos.x, v.pos.y}, {v.uv.x, v.uv.y}, {c.x, c.y, c.z, c.w}};
}

float cross(glm::vec2 a, glm::vec2 b) {
  return a.x * b.y - a.y * b.x;
}

/// On which side of the edge from a to b a point lies; exactly the opposite for the edge from b to a, so that two
/// triangles leave no pixel between them.
float side(glm::vec2 a, glm::vec2 b, glm::vec2 p) {
  const bool flip = b.x < a.x || (b.x == a.x && b.y < a.y);
  return flip ? -cross(a - b, p - b) : cross(b - a, p - a);
}

/// Pixels on a shared edge belong to one of the two triangles: the rule of the top and left edges.
bool owns(float weight, glm::vec2 edge) {
  return weight > 0.0f || (weight == 0.0f && (edge.y < 0.0f || (edge.y == 0.0f && edge.x > 0.0f)));
}

void triangle(image::Image& out, std::array<Corner, 3> c, const ImVec4& clip, const Texture& texture) {
  float area = cross(c[1].at - c[0].at, c[2].at - c[0].at);
  if (area == 0.0f) return;
  if (area < 0.0f) {
    std::swap(c[1], c[2]);
    area = -area;
  }
  const auto [minX, maxX] = std::minmax({c[0].at.x, c[1].at.x, c[2].at.x});
  const auto [minY, maxY] = std::minmax({c[0].at.y, c[1].at.y, c[2].at.y});
  const int x0 = std::max({0, static_cast<int>(clip.x), static_cast<int>(std::floor(minX))});
  const int y0 = std::max({0, static_cast<int>(clip.y), static_cast<int>(std::floor(minY))});
  const int x1 = std::min({out.width, static_cast<int>(clip.z), static_cast<int>(std::ceil(maxX))});
  const int y1 = std::min({out.height, static_cast<int>(clip.w), static_cast<int>(std::ceil(maxY))});
  const glm::vec2 e0 = c[2].at - c[1].at, e1 = c[0].at - c[2].at, e2 = c[1].at - c[0].at;
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      const glm::vec2 p(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      const float w0 = side(c[1].at, c[2].at, p), w1 = side(c[2].at, c[0].at, p), w2 = side(c[0].at, c[1].at, p);
      if (!owns(w0, e0) || !owns(w1, e1) || !owns(w2, e2)) continue;
      const glm::vec3 w = glm::vec3(w0, w1, w2) / area;
      const glm::vec4 colour = w.x * c[0].colour + w.y * c[1].colour + w.z * c[2].colour;
      const float alpha = colour.a * texture.sample(w.x * c[0].uv + w.y * c[1].uv + w.z * c[2].uv);
      for (int i = 0; i < 3; ++i) out.at(x, y, i) = glm::mix(out.at(x, y, i), colour[i], alpha);
    }
  }
}

}  // namespace

image::Image rasterised(const ImDrawData& data, ImFontAtlas& fonts, ImU32 background) {
  image::Image out(static_cast<int>(data.DisplaySize.x), static_cast<int>(data.DisplaySize.y), 3);
  const ImVec4 back = ImGui::ColorConvertU32ToFloat4(background);
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      out.at(x, y, 0) = back.x;
      out.at(x, y, 1) = back.y;
      out.at(x, y, 2) = back.z;
    }
  }
  unsigned char* pixels = nullptr;
  Texture texture{};
  fonts.GetTexDataAsAlpha8(&pixels, &texture.width, &texture.height);
  texture.alpha = pixels;
  for (int l = 0; l < data.CmdListsCount; ++l) {
    const ImDrawList& list = *data.CmdLists[l];
    for (const ImDrawCmd& command : list.CmdBuffer) {
      for (unsigned i = 0; i + 2 < command.ElemCount; i += 3) {
        const auto at = [&](unsigned k) {
          const int index = list.IdxBuffer[static_cast<int>(command.IdxOffset + i + k)];
          return corner(list.VtxBuffer[static_cast<int>(command.VtxOffset) + index]);
        };
        triangle(out, {at(0), at(1), at(2)}, command.ClipRect, texture);
      }
    }
  }
  return out;
}

}  // namespace sward::editor
