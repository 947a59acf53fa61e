#include "app/dialogs.h"

#include "project/limits.h"
#include "widgets/icons.h"
#include "widgets/item_log.h"
#include "widgets/theme.h"

#include <algorithm>

#include <imgui.h>
#include <imgui_stdlib.h>

namespace sward::editor {

void Dialogs::openRender(const Document& document, const UiState& ui) {
  const project::Project& project = document.project();
  m_render.fromCamera = !ui.boundView.has_value();
  m_render.view = ui.boundView.value_or(0);
  m_render.width = project.output.width;
  m_render.height = project.output.height;
  m_render.samples = project.render.samples;
  if (m_render.file.empty()) {
    const std::filesystem::path base =
        document.file().empty() ? std::filesystem::current_path() / "meadow" : document.file();
    m_render.file = std::filesystem::path(base).replace_extension(".png").string();
  }
  open(Kind::Render);
}

void Dialogs::startPicture(const Input& input) {
  auto project = std::make_shared<project::Project>(input.document.project());
  project->output = {m_render.width, m_render.height};
  project->render.samples = m_render.samples;
  const bool camera = m_render.fromCamera || m_render.view >= project->views.size();
  const scene::View view = camera ? input.ui.camera : project->views[m_render.view];
  m_picture = std::make_unique<PictureJob>(PictureJob::Request{std::move(project), view, m_render.file,
                                                               input.cacheFolder, input.preferences.cacheLimitBytes,
                                                               input.threads, input.device, input.act.wake});
}

void Dialogs::drawRender(const Input& input) {
  if (!begin("Render picture", input, 520.0f)) return;
  if (m_picture) {
    drawPictureProgress(input);
    ImGui::EndPopup();
    return;
  }
  const auto& views = input.document.project().views;
  const auto row = [](const char* label) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextDisabled("%s", label);
    ImGui::SameLine(px(110.0f));
    ImGui::SetNextItemWidth(-1.0f);
  };
  row("View");
  const bool camera = m_render.fromCamera || m_render.view >= views.size();
  if (ImGui::BeginCombo("##view", camera ? "The camera as it stands" : views[m_render.view].name.c_str())) {
    if (ImGui::Selectable("The camera as it stands", camera)) m_render.fromCamera = true;
    for (std::size_t i = 0; i < views.size(); ++i) {
      if (!ImGui::Selectable((views[i].name + "##" + std::to_string(i)).c_str(), !camera && m_render.view == i))
        continue;
      m_render.fromCamera = false;
      m_render.view = i;
    }
    ImGui::EndCombo();
  }
  row("Size");
  int size[2] = {m_render.width, m_render.height};
  ImGui::InputInt2("##size", size);
  m_render.width = std::clamp(size[0], 1, 16384);
  m_render.height = std::clamp(size[1], 1, 16384);
  row("Samples");
  ImGui::InputInt("##samples", &m_render.samples, 4, 16);
  m_render.samples = std::clamp(m_render.samples, 1, 4096);
  row("File");
  ImGui::SetNextItemWidth(-px(40.0f));
  ImGui::InputText("##file", &m_render.file);
  logItem("render.file");
  ImGui::SameLine();
  if (ImGui::Button(icon::kFolder)) {
    close();
    ImGui::EndPopup();
    input.act.chooseOutput([this](const std::filesystem::path& file) {
      m_render.file = file.string();
      open(Kind::Render);
    });
    return;
  }
  ImGui::TextDisabled(".png: sRGB as it looks; .exr: linear light");
  ImGui::Dummy({0.0f, px(8.0f)});
  if (button("Render", "render", true)) startPicture(input);
  ImGui::SameLine();
  if (button("Cancel", "cancel")) close();
  ImGui::EndPopup();
}

void Dialogs::drawPictureProgress(const Input& input) {
  const PictureJob::Status status = m_picture->status();
  if (status.finished) {
    if (status.error) {
      ImGui::TextWrapped("%s", status.error->text().c_str());
      if (button("Back", "back", true)) m_picture.reset();
      return;
    }
    input.act.notice("Wrote " + m_picture->output().string());
    m_picture.reset();
    close();
    return;
  }
  ImGui::TextUnformatted(status.stage.c_str());
  ImGui::ProgressBar(static_cast<float>(status.fraction), {-1.0f, px(10.0f)}, "");
  ImGui::Dummy({0.0f, px(8.0f)});
  if (button("Stop", "stop")) {
    m_picture->cancel();
    m_picture.reset();
  }
}

}  // namespace sward::editor
