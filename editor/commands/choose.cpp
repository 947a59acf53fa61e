#include "choose.h"

#include "bake/withering.h"

namespace sward::editor {
namespace {

Json candidateJson(const report::Candidate& candidate) {
  Json json = {
      {"method", candidate.method.name}, {"resolution", candidate.sliceResolution}, {"layers", candidate.slices}};
  if (candidate.lights > 0) json["lights"] = candidate.lights;
  return json;
}

}  // namespace

Result<std::optional<report::Choice>> chooseBake(const Program& program, project::Project& project,
                                                 const std::vector<scene::View>& views, gpu::Context& context) {
  if (project.accuracy.metric == report::ErrorBound::None) return std::optional<report::Choice>();
  if (bake::drawnAsTexels(project)) {
    return Error::badInput("an error bound chooses among layers, and this project is drawn as texels", "accuracy",
                           "Leave --max-error out, or draw layers: --method march.");
  }
  std::optional<report::Choice> choice;
  {
    ProgressBar bar(program);
    SWARD_ASSIGN(choice, report::chooseCheapest({project, views, context, cacheFolder(program), {}}, bar.job()));
  }
  report::applyCandidate(choice->chosen, project);
  SWARD_TRY(project::requireValid(project));
  (choice->met ? say : warn)(program, report::choiceText(*choice));
  return choice;
}

Json choiceJson(const report::Choice& choice) {
  Json json = {{"chosen", candidateJson(choice.chosen)}, {"met", choice.met}, {"referenceNoise", choice.noise}};
  json["measured"] = Json::array();
  for (const report::Trial& trial : choice.trials) {
    Json entry = candidateJson(trial.candidate);
    if (trial.floor) entry["method"] = "sampled";
    entry["error"] = trial.value;
    entry["view"] = trial.worstView;
    entry["drawMs"] = trial.drawMs;
    if (!trial.floor) entry["relightMs"] = trial.relightMs;
    entry["meets"] = trial.meets;
    json["measured"].push_back(std::move(entry));
  }
  return json;
}

}  // namespace sward::editor
