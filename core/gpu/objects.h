#pragma once

#include "gpu/gl.h"

#include <cstddef>
#include <span>
#include <utility>

namespace sward::gpu {

/// Owns one OpenGL name; 0 owns nothing. `Destroy` deletes it on the context that is current, which must be the one
/// that made it.
template <void (*Destroy)(GLuint)>
class Handle {
 public:
  Handle() = default;
  explicit Handle(GLuint name) : m_name(name) {}
  Handle(Handle&& other) noexcept : m_name(std::exchange(other.m_name, 0)) {}
  Handle& operator=(Handle&& other) noexcept {
    if (this != &other) {
      reset();
      m_name = std::exchange(other.m_name, 0);
    }
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { reset(); }

  GLuint name() const { return m_name; }
  explicit operator bool() const { return m_name != 0; }

 private:
  void reset() {
    if (m_name != 0) Destroy(m_name);
    m_name = 0;
  }
  GLuint m_name = 0;
};

void destroyBuffer(GLuint name);
void destroyTexture(GLuint name);
void destroyFramebuffer(GLuint name);
void destroyVertexArray(GLuint name);

/// A buffer of fixed size.
class Buffer {
 public:
  Buffer() = default;
  /// `size` bytes, contents undefined; at least 16 are allocated so that an empty buffer can be bound.
  explicit Buffer(std::size_t size);
  explicit Buffer(std::span<const std::byte> data);
  GLuint name() const { return m_handle.name(); }
  std::size_t size() const { return m_size; }
  /// Replaces the first data.size() bytes.
  void write(std::span<const std::byte> data);
  /// Reads out.size() bytes from byte `offset`.
  void read(std::size_t offset, std::span<std::byte> out) const;
  void bindStorage(GLuint binding) const;

 private:
  Handle<destroyBuffer> m_handle;
  std::size_t m_size = 0;
};

/// A two-dimensional texture, or the view of a buffer as one.
class Texture {
 public:
  Texture() = default;
  /// One level, nearest filtering, clamped.
  static Texture make2d(GLenum internalFormat, int width, int height);
  static Texture ofBuffer(GLenum internalFormat, const Buffer& buffer);
  GLuint name() const { return m_handle.name(); }
  int width() const { return m_width; }
  int height() const { return m_height; }
  void write(GLenum format, GLenum type, const void* pixels);
  void setLinear(bool repeatX, bool repeatY);
  void bind(GLuint unit) const;

 private:
  Handle<destroyTexture> m_handle;
  int m_width = 0, m_height = 0;
};

class Framebuffer {
 public:
  Framebuffer() = default;
  explicit Framebuffer(const Texture& colour);
  Framebuffer(const Texture& colour, const Texture& depth);
  GLuint name() const { return m_handle.name(); }
  bool complete() const;
  void bind() const;

 private:
  Handle<destroyFramebuffer> m_handle;
};

/// A vertex array without attributes: our passes make their vertices from gl_VertexID.
class VertexArray {
 public:
  VertexArray() = default;
  static VertexArray make();
  void bind() const;
  /// Where indices are read from; the buffer must outlive what is drawn.
  void setElements(const Buffer& indices);

 private:
  Handle<destroyVertexArray> m_handle;
};

}  // namespace sward::gpu
