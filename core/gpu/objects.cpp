#include "gpu/objects.h"

#include <algorithm>

namespace sward::gpu {

void destroyBuffer(GLuint name) {
  gl().DeleteBuffers(1, &name);
}
void destroyTexture(GLuint name) {
  gl().DeleteTextures(1, &name);
}
void destroyFramebuffer(GLuint name) {
  gl().DeleteFramebuffers(1, &name);
}
void destroyVertexArray(GLuint name) {
  gl().DeleteVertexArrays(1, &name);
}

Buffer::Buffer(std::size_t size) : m_size(size) {
  GLuint name = 0;
  gl().CreateBuffers(1, &name);
  m_handle = Handle<destroyBuffer>(name);
  gl().NamedBufferStorage(name, static_cast<GLsizeiptr>(std::max<std::size_t>(size, 16)), nullptr,
                          GL_DYNAMIC_STORAGE_BIT);
}

Buffer::Buffer(std::span<const std::byte> data) : Buffer((data.size() + 3) / 4 * 4) {
  write(data);
}

void Buffer::write(std::span<const std::byte> data) {
  if (!data.empty()) gl().NamedBufferSubData(name(), 0, static_cast<GLsizeiptr>(data.size()), data.data());
}

void Buffer::read(std::size_t offset, std::span<std::byte> out) const {
  gl().GetNamedBufferSubData(name(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(out.size()), out.data());
}

void Buffer::bindStorage(GLuint binding) const {
  gl().BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, name());
}

Texture Texture::make2d(GLenum internalFormat, int width, int height) {
  Texture texture;
  GLuint name = 0;
  gl().CreateTextures(GL_TEXTURE_2D, 1, &name);
  texture.m_handle = Handle<destroyTexture>(name);
  texture.m_width = width;
  texture.m_height = height;
  gl().TextureStorage2D(name, 1, internalFormat, width, height);
  gl().TextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl().TextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  gl().TextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl().TextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

Texture Texture::ofBuffer(GLenum internalFormat, const Buffer& buffer) {
  Texture texture;
  GLuint name = 0;
  gl().CreateTextures(GL_TEXTURE_BUFFER, 1, &name);
  texture.m_handle = Handle<destroyTexture>(name);
  gl().TextureBuffer(name, internalFormat, buffer.name());
  return texture;
}

void Texture::write(GLenum format, GLenum type, const void* pixels) {
  gl().PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl().TextureSubImage2D(name(), 0, 0, 0, m_width, m_height, format, type, pixels);
}

void Texture::setLinear(bool repeatX, bool repeatY) {
  gl().TextureParameteri(name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl().TextureParameteri(name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl().TextureParameteri(name(), GL_TEXTURE_WRAP_S, repeatX ? GL_REPEAT : GL_CLAMP_TO_EDGE);
  gl().TextureParameteri(name(), GL_TEXTURE_WRAP_T, repeatY ? GL_REPEAT : GL_CLAMP_TO_EDGE);
}

void Texture::bind(GLuint unit) const {
  gl().BindTextureUnit(unit, name());
}

Framebuffer::Framebuffer(const Texture& colour) {
  GLuint name = 0;
  gl().CreateFramebuffers(1, &name);
  m_handle = Handle<destroyFramebuffer>(name);
  gl().NamedFramebufferTexture(name, GL_COLOR_ATTACHMENT0, colour.name(), 0);
}

Framebuffer::Framebuffer(const Texture& colour, const Texture& depth) : Framebuffer(colour) {
  gl().NamedFramebufferTexture(name(), GL_DEPTH_ATTACHMENT, depth.name(), 0);
}

bool Framebuffer::complete() const {
  return gl().CheckNamedFramebufferStatus(name(), GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

void Framebuffer::bind() const {
  gl().BindFramebuffer(GL_FRAMEBUFFER, name());
}

VertexArray VertexArray::make() {
  VertexArray array;
  GLuint name = 0;
  gl().CreateVertexArrays(1, &name);
  array.m_handle = Handle<destroyVertexArray>(name);
  return array;
}

void VertexArray::setElements(const Buffer& indices) {
  gl().VertexArrayElementBuffer(m_handle.name(), indices.name());
}

void VertexArray::bind() const {
  gl().BindVertexArray(m_handle.name());
}

}  // namespace sward::gpu
