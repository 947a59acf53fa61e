#include "base/check.h"
#include "gpu/context.h"
#include "gpu/program.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace sward::gpu {
namespace {

class Programs : public testing::Test {
 protected:
  void SetUp() override {
    auto made = Context::create(Device::Auto);
    ASSERT_TRUE(made.ok()) << made.error().text();
    context = std::move(made).value();
  }

  ShaderLookup lookup() const {
    return [this](std::string_view name) -> std::optional<std::string_view> {
      const auto found = files.find(std::string(name));
      if (found == files.end()) return std::nullopt;
      return found->second;
    };
  }

  ProgramSource computeOf(const std::string& file) const { return {{{GL_COMPUTE_SHADER, file}}, {}, {}}; }

  std::unique_ptr<Context> context;
  std::map<std::string, std::string> files{
      {"ok.comp",
       "layout(local_size_x = 1) in;\n#include \"part/value.glsl\"\n#include \"part/value.glsl\"\n"
       "layout(std430, binding = 0) buffer Out { float b_out[]; };\nuniform float u_add;\n"
       "void main() { b_out[0] = value() + u_add + SWARD_FACTOR; }\n"},
      {"part/value.glsl", "float value() { return 2.0; }\n"},
      {"bad.comp", "layout(local_size_x = 1) in;\n#include \"part/bad.glsl\"\nvoid main() { broken(); }\n"},
      {"part/bad.glsl", "float fine;\nfloat broken() {\n  return undeclared_thing;\n}\n"},
      {"missing.comp", "layout(local_size_x = 1) in;\n\n#include \"part/none.glsl\"\nvoid main() {}\n"},
      {"nameless.comp", "#include part\nvoid main() {}\n"},
      {"late.comp", "#include \"part/value.glsl\"\nlayout(local_size_x = 1) in;\nvoid main() { oops }\n"}};
};

TEST_F(Programs, RunWithIncludesDefinesAndUniforms) {
  ProgramSource source = computeOf("ok.comp");
  source.defines = {{"SWARD_FACTOR", "10.0"}};
  source.uniforms = {"u_add"};
  auto program = Program::build(lookup(), source);
  ASSERT_TRUE(program.ok()) << program.error().text();
  const Buffer out(std::size_t{16});
  out.bindStorage(0);
  program->use();
  program->set("u_add", 0.5f);
  gl().DispatchCompute(1, 1, 1);
  gl().MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  float result = 0.0f;
  out.read(0, std::as_writable_bytes(std::span(&result, 1)));
  EXPECT_EQ(result, 12.5f);
  EXPECT_TRUE(context->checkErrors("running").ok());
}

TEST_F(Programs, ErrorsNameTheFileAndItsOwnLine) {
  const auto program = Program::build(lookup(), computeOf("bad.comp"));
  ASSERT_FALSE(program.ok());
  const std::string text = program.error().text();
  EXPECT_NE(text.find("part/bad.glsl:3"), std::string::npos) << text;
  EXPECT_NE(text.find("undeclared_thing"), std::string::npos) << text;
}

TEST_F(Programs, LinesAfterAnIncludeKeepTheirNumbers) {
  const auto program = Program::build(lookup(), computeOf("late.comp"));
  ASSERT_FALSE(program.ok());
  EXPECT_NE(program.error().text().find("late.comp:3"), std::string::npos) << program.error().text();
}

TEST_F(Programs, MissingFilesAreNamedWithTheIncludingLine) {
  const auto include = Program::build(lookup(), computeOf("missing.comp"));
  ASSERT_FALSE(include.ok());
  EXPECT_EQ(include.error().where, "missing.comp:3");
  EXPECT_NE(include.error().what.find("part/none.glsl"), std::string::npos);
  EXPECT_FALSE(Program::build(lookup(), computeOf("nowhere.comp")).ok());
  EXPECT_FALSE(Program::build(lookup(), computeOf("nameless.comp")).ok());
}

TEST_F(Programs, DeclaredUniformsMustBeThere) {
  ProgramSource source = computeOf("ok.comp");
  source.defines = {{"SWARD_FACTOR", "10.0"}};
  source.uniforms = {"u_absent"};
  const auto program = Program::build(lookup(), source);
  ASSERT_FALSE(program.ok());
  EXPECT_NE(program.error().text().find("u_absent"), std::string::npos);
}

TEST_F(Programs, SettingAnUnknownUniformIsABrokenContract) {
  ProgramSource source = computeOf("ok.comp");
  source.defines = {{"SWARD_FACTOR", "10.0"}};
  auto program = Program::build(lookup(), source);
  ASSERT_TRUE(program.ok());
  EXPECT_FALSE(program->has("u_typo"));
  EXPECT_THROW(program->set("u_typo", 1.0f), base::ContractError);
}

}  // namespace
}  // namespace sward::gpu
