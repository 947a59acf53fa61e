#include "gpu/context.h"
#include "gpu/objects.h"

#include <gtest/gtest.h>

#include <array>
#include <numeric>
#include <vector>

namespace sward::gpu {
namespace {

class EveryDevice : public testing::TestWithParam<Device> {};
std::string deviceName(const testing::TestParamInfo<Device>& test) {
  return test.param == Device::Egl ? "Egl" : "OsMesa";
}
INSTANTIATE_TEST_SUITE_P(Contexts, EveryDevice, testing::Values(Device::Egl, Device::OsMesa), deviceName);

TEST_P(EveryDevice, MakesACoreContextThatSaysWhatItIs) {
  auto context = Context::create(GetParam());
  ASSERT_TRUE(context.ok()) << context.error().text();
  const DeviceInfo& info = (*context)->info();
  EXPECT_EQ(info.api, GetParam() == Device::Egl ? "EGL" : "OSMesa");
  EXPECT_FALSE(info.renderer.empty());
  EXPECT_FALSE(info.vendor.empty());
  GLint profile = 0;
  gl().GetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
  EXPECT_TRUE((profile & GL_CONTEXT_CORE_PROFILE_BIT) != 0);
  EXPECT_TRUE((*context)->checkErrors("nothing").ok());
}

TEST_P(EveryDevice, DrawsIntoItsOwnFramebuffer) {
  auto context = Context::create(GetParam());
  ASSERT_TRUE(context.ok());
  const Texture colour = Texture::make2d(GL_RGBA32F, 3, 2);
  const Framebuffer framebuffer(colour);
  ASSERT_TRUE(framebuffer.complete());
  constexpr std::array<float, 4> value{0.25f, 0.5f, 0.75f, 1.0f};
  gl().ClearNamedFramebufferfv(framebuffer.name(), GL_COLOR, 0, value.data());
  std::vector<float> pixels(3 * 2 * 4);
  gl().GetTextureImage(colour.name(), 0, GL_RGBA, GL_FLOAT, static_cast<GLsizei>(pixels.size() * 4), pixels.data());
  for (std::size_t i = 0; i < pixels.size(); ++i) EXPECT_EQ(pixels[i], value[i % 4]);
}

TEST_P(EveryDevice, ReportsErrorsOnceWithTheirPlace) {
  auto context = Context::create(GetParam());
  ASSERT_TRUE(context.ok());
  gl().Enable(0xdead);
  const auto first = (*context)->checkErrors("the test");
  ASSERT_FALSE(first.ok());
  EXPECT_NE(first.error().text().find("the test"), std::string::npos);
  EXPECT_NE(first.error().text().find("GL_INVALID_ENUM"), std::string::npos);
  EXPECT_TRUE((*context)->checkErrors("the test").ok());
}

TEST(Contexts, TwoKindsLiveOnOneThread) {
  auto egl = Context::create(Device::Egl);
  ASSERT_TRUE(egl.ok()) << egl.error().text();
  std::vector<std::byte> first(64, std::byte{1}), second(64, std::byte{2}), read(64);
  Buffer inEgl{std::span<const std::byte>(first)};
  auto osMesa = Context::create(Device::OsMesa);
  ASSERT_TRUE(osMesa.ok()) << osMesa.error().text();
  Buffer inOsMesa{std::span<const std::byte>(second)};
  // Both contexts give out small names; each must still see its own data.
  for (int turn = 0; turn < 3; ++turn) {
    ASSERT_TRUE((*egl)->makeCurrent().ok());
    inEgl.read(0, read);
    EXPECT_EQ(read, first);
    ASSERT_TRUE((*osMesa)->makeCurrent().ok());
    inOsMesa.read(0, read);
    EXPECT_EQ(read, second);
  }
  { const Buffer gone = std::move(inOsMesa); }
  EXPECT_TRUE((*osMesa)->checkErrors("deleting").ok());
  ASSERT_TRUE((*egl)->makeCurrent().ok());
  { const Buffer gone = std::move(inEgl); }
  EXPECT_TRUE((*egl)->checkErrors("deleting").ok());
}

TEST(Contexts, ADestroyedContextLeavesTheOtherUsable) {
  auto egl = Context::create(Device::Egl);
  ASSERT_TRUE(egl.ok());
  {
    auto osMesa = Context::create(Device::OsMesa);
    ASSERT_TRUE(osMesa.ok());
  }
  ASSERT_TRUE((*egl)->makeCurrent().ok());
  std::vector<std::byte> data(16, std::byte{7}), read(16);
  const Buffer buffer{std::span<const std::byte>(data)};
  buffer.read(0, read);
  EXPECT_EQ(read, data);
}

TEST(Contexts, AWindowIsRefusedWithARemedy) {
  const auto context = Context::create(Device::Window);
  ASSERT_FALSE(context.ok());
  EXPECT_FALSE(context.error().remedy.empty());
}

TEST(Contexts, NamesOfDevices) {
  EXPECT_EQ(deviceFromName("auto").value(), Device::Auto);
  EXPECT_EQ(deviceFromName("egl").value(), Device::Egl);
  EXPECT_EQ(deviceFromName("osmesa").value(), Device::OsMesa);
  EXPECT_EQ(deviceFromName("window").value(), Device::Window);
  const auto wrong = deviceFromName("vulkan");
  ASSERT_FALSE(wrong.ok());
  EXPECT_NE(wrong.error().text().find("vulkan"), std::string::npos);
}

TEST(Objects, MoveAndLeaveNothingBehind) {
  auto context = Context::create(Device::Auto);
  ASSERT_TRUE(context.ok());
  std::vector<std::byte> data(32, std::byte{3});
  Buffer a{std::span<const std::byte>(data)};
  const GLuint name = a.name();
  Buffer b = std::move(a);
  EXPECT_EQ(b.name(), name);
  EXPECT_EQ(a.name(), 0u);  // NOLINT: the moved-from state is what is tested
  b = Buffer(std::size_t{64});
  EXPECT_EQ(b.size(), 64u);
  EXPECT_TRUE((*context)->checkErrors("moving").ok());
}

}  // namespace
}  // namespace sward::gpu
