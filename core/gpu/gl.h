#pragma once

#include <GL/glcorearb.h>

namespace sward::gpu {

/// Every OpenGL function that sward uses, as X(type, name): a member `name` of type PFNGL<type>PROC.
#define SWARD_GL_FUNCTIONS(X)                                 \
  X(ATTACHSHADER, AttachShader)                               \
  X(BINDBUFFERBASE, BindBufferBase)                           \
  X(BINDFRAMEBUFFER, BindFramebuffer)                         \
  X(BINDTEXTUREUNIT, BindTextureUnit)                         \
  X(BINDVERTEXARRAY, BindVertexArray)                         \
  X(BLENDFUNC, BlendFunc)                                     \
  X(CHECKNAMEDFRAMEBUFFERSTATUS, CheckNamedFramebufferStatus) \
  X(CLEARNAMEDFRAMEBUFFERFV, ClearNamedFramebufferfv)         \
  X(CLIPCONTROL, ClipControl)                                 \
  X(COMPILESHADER, CompileShader)                             \
  X(CREATEBUFFERS, CreateBuffers)                             \
  X(CREATEFRAMEBUFFERS, CreateFramebuffers)                   \
  X(CREATEPROGRAM, CreateProgram)                             \
  X(CREATESHADER, CreateShader)                               \
  X(CREATETEXTURES, CreateTextures)                           \
  X(CREATEVERTEXARRAYS, CreateVertexArrays)                   \
  X(DEBUGMESSAGECALLBACK, DebugMessageCallback)               \
  X(DELETEBUFFERS, DeleteBuffers)                             \
  X(DELETEFRAMEBUFFERS, DeleteFramebuffers)                   \
  X(DELETEPROGRAM, DeleteProgram)                             \
  X(DELETESHADER, DeleteShader)                               \
  X(DELETETEXTURES, DeleteTextures)                           \
  X(DELETEVERTEXARRAYS, DeleteVertexArrays)                   \
  X(DEPTHFUNC, DepthFunc)                                     \
  X(DISABLE, Disable)                                         \
  X(DISPATCHCOMPUTE, DispatchCompute)                         \
  X(DRAWARRAYSINSTANCED, DrawArraysInstanced)                 \
  X(DRAWELEMENTS, DrawElements)                               \
  X(ENABLE, Enable)                                           \
  X(FINISH, Finish)                                           \
  X(GETACTIVEUNIFORM, GetActiveUniform)                       \
  X(GETERROR, GetError)                                       \
  X(GETINTEGERV, GetIntegerv)                                 \
  X(GETNAMEDBUFFERSUBDATA, GetNamedBufferSubData)             \
  X(GETPROGRAMINFOLOG, GetProgramInfoLog)                     \
  X(GETPROGRAMIV, GetProgramiv)                               \
  X(GETSHADERINFOLOG, GetShaderInfoLog)                       \
  X(GETSHADERIV, GetShaderiv)                                 \
  X(GETSTRING, GetString)                                     \
  X(GETTEXTUREIMAGE, GetTextureImage)                         \
  X(GETUNIFORMLOCATION, GetUniformLocation)                   \
  X(LINKPROGRAM, LinkProgram)                                 \
  X(MEMORYBARRIER, MemoryBarrier)                             \
  X(NAMEDBUFFERSTORAGE, NamedBufferStorage)                   \
  X(NAMEDBUFFERSUBDATA, NamedBufferSubData)                   \
  X(NAMEDFRAMEBUFFERTEXTURE, NamedFramebufferTexture)         \
  X(PIXELSTOREI, PixelStorei)                                 \
  X(PROGRAMUNIFORM1F, ProgramUniform1f)                       \
  X(PROGRAMUNIFORM1FV, ProgramUniform1fv)                     \
  X(PROGRAMUNIFORM1I, ProgramUniform1i)                       \
  X(PROGRAMUNIFORM1UI, ProgramUniform1ui)                     \
  X(PROGRAMUNIFORM1UIV, ProgramUniform1uiv)                   \
  X(PROGRAMUNIFORM2FV, ProgramUniform2fv)                     \
  X(PROGRAMUNIFORM2IV, ProgramUniform2iv)                     \
  X(PROGRAMUNIFORM3FV, ProgramUniform3fv)                     \
  X(PROGRAMUNIFORM4FV, ProgramUniform4fv)                     \
  X(SCISSOR, Scissor)                                         \
  X(SHADERSOURCE, ShaderSource)                               \
  X(TEXTUREBUFFER, TextureBuffer)                             \
  X(TEXTUREPARAMETERI, TextureParameteri)                     \
  X(TEXTURESTORAGE2D, TextureStorage2D)                       \
  X(TEXTURESUBIMAGE2D, TextureSubImage2D)                     \
  X(USEPROGRAM, UseProgram)                                   \
  X(VERTEXARRAYELEMENTBUFFER, VertexArrayElementBuffer)       \
  X(VIEWPORT, Viewport)

/// Function pointers of one context, resolved through that context's own loader.
struct Functions {
#define SWARD_GL_MEMBER(type, name) PFNGL##type##PROC name = nullptr;
  SWARD_GL_FUNCTIONS(SWARD_GL_MEMBER)
#undef SWARD_GL_MEMBER
};

/// The functions of the context that is current on this thread. A broken contract (ContractError) when none is.
const Functions& gl();

}  // namespace sward::gpu
