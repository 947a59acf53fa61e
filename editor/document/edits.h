#pragma once

#include "project/project.h"

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

/// Edits of lists that panels send through Document::edit. Each leaves a project that could be saved: names stay
/// unique, lists within the limits of the format (project/limits.h). An index out of its list changes nothing.
namespace sward::editor {

/// "after the last entry" where an edit asks after which one a new entry goes.
inline constexpr std::size_t kAtEnd = std::numeric_limits<std::size_t>::max();

/// `name`, or "name 2", "name 3", ... where `taken` holds it; a number at the end of `name` counts on. Spaces at both
/// ends are cut off; an empty name becomes `fallback`.
std::string uniqueName(const std::string& name, const std::vector<std::string>& taken, const std::string& fallback);

/// The new plant's index; nothing when the list is full. A name that is taken gets a number. A share of 0 becomes the
/// mean of the others' (1 when there are none), so that the plant is seen.
std::optional<std::size_t> addPlant(project::Project& project, project::Plant plant, std::size_t after = kAtEnd);
/// The copy's index, right after its original.
std::optional<std::size_t> duplicatePlant(project::Project& project, std::size_t index);
bool removePlant(project::Project& project, std::size_t index);
/// Takes the plant out and puts it where it then has the index `to` (the last place at most).
bool movePlant(project::Project& project, std::size_t from, std::size_t to);
/// The name that the plant has now: as asked for, made unique; an empty one changes nothing.
std::string renamePlant(project::Project& project, std::size_t index, const std::string& name);

std::optional<std::size_t> addView(project::Project& project, scene::View view, std::size_t after = kAtEnd);
std::optional<std::size_t> duplicateView(project::Project& project, std::size_t index);
bool removeView(project::Project& project, std::size_t index);
bool moveView(project::Project& project, std::size_t from, std::size_t to);
std::string renameView(project::Project& project, std::size_t index, const std::string& name);
/// Gives the view the camera of `camera`; its name stays.
bool updateView(project::Project& project, std::size_t index, const scene::View& camera);

/// Chooses an autumn. Own curves begin with those of the autumn before; curves that were set earlier are kept.
void chooseAutumn(project::Project& project, wither::Autumn autumn);
/// Gives the ageing these curves of water or chlorophyll: it becomes an autumn of own curves, and the other curve stays
/// what it was under the autumn before.
void setWater(project::Project& project, const base::Curve& curve);
void setChlorophyll(project::Project& project, const base::Curve& curve);

/// The new sample's index, after the last; nothing when the list is full. The first one is added to the whole sward: it
/// and "rest" share the blades.
std::optional<std::size_t> addMingleSample(project::Project& project);
/// Green blades that lag behind, blades that age with the sward, and straw that is ahead of it, in place of all
/// samples.
void mingleGreenTurningStraw(project::Project& project);
bool removeMingleSample(project::Project& project, std::size_t index);

/// Turns the lights into a list of these directions (scene::lightDirections of what they were, say). False, and no
/// change, when there are none or more than the format holds.
bool convertToList(project::Project& project, const std::vector<scene::SunAngles>& directions);
/// A pattern of `count` lights, held within the limits; the list is kept for a way back.
void usePattern(project::Project& project, scene::LightPattern pattern, int count);
/// Edits of single lights work on a list alone. Azimuths are wrapped to [0, 360), elevations held in [0, 90].
std::optional<std::size_t> addLight(project::Project& project, const scene::SunAngles& angles);
bool moveLight(project::Project& project, std::size_t index, const scene::SunAngles& angles);
/// The last light stays: a list without any cannot be baked.
bool removeLight(project::Project& project, std::size_t index);

}  // namespace sward::editor
