// The document against a reference history kept as JSON text: every edit undone and redone, and long random sequences.

#include "document/document.h"
#include "document/edits.h"
#include "project/presets.h"
#include "project/assets.h"

#include "project/fields.h"

#include <random>

#include <gtest/gtest.h>

namespace sward::editor {
namespace {

using project::Project;
using project::toJson;
using project::test::Json;
using Random = std::mt19937_64;
using Change = std::function<void(Project&)>;

std::size_t pick(Random& random, std::size_t count) {
  return count == 0 ? 0 : random() % count;
}

double uniform(Random& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1.0p-53;
}

/// Changes one value of the document, whichever of all its fields, as its text says it.
void changeAnyField(Project& project, Random& random) {
  Json json = Json::parse(toJson(project));
  const auto fields = project::test::leaves(json);
  const auto& field = fields[pick(random, fields.size())];
  if (field.to_string() == "/version") return;
  json[field] = project::test::changed(json[field]);
  // A curve's points may swap their order by it: no such curve exists, and nothing is changed.
  if (auto changed = project::parse(json.dump(), project.folder / "p.sward"); changed.ok()) {
    project = *std::move(changed);
  }
}

void setCurve(Project& project, Random& random) {
  if (project.patch.plants.empty()) return;
  const double x = uniform(random, 0.1, 0.9);
  project.patch.plants[pick(random, project.patch.plants.size())].grass.profile =
      base::Curve::fromPoints({{0.0, 0.5}, {x, uniform(random, 0.0, 1.0)}, {1.0, 0.0}}).value();
}

scene::SunAngles anyAngles(Random& random) {
  return {uniform(random, -400, 400), uniform(random, -20, 100)};
}

struct NamedEdit {
  const char* name;
  void (*change)(Project&, Random&);
};

/// Every edit of edits.h, relocation and changes of fields; each draws its arguments from `random`.
const NamedEdit kEdits[] = {
    {"add plant",
     [](Project& p, Random& r) {
       const auto& presets = project::plantPresets();
       const project::Plant& plant = presets[pick(r, presets.size())].plant;
       if (p.patch.plants.size() < 8) addPlant(p, plant, pick(r, p.patch.plants.size() + 1));
     }},
    {"duplicate plant",
     [](Project& p, Random& r) {
       if (p.patch.plants.size() < 8) duplicatePlant(p, pick(r, p.patch.plants.size()));
     }},
    {"remove plant", [](Project& p, Random& r) { removePlant(p, pick(r, p.patch.plants.size() + 1)); }},
    {"move plant",
     [](Project& p, Random& r) {
       const std::size_t from = pick(r, p.patch.plants.size());
       movePlant(p, from, pick(r, p.patch.plants.size() + 1));
     }},
    {"rename plant",
     [](Project& p, Random& r) { renamePlant(p, pick(r, p.patch.plants.size()), "plant " + std::to_string(r() % 4)); }},
    {"add view",
     [](Project& p, Random& r) {
       scene::View view;
       view.position.x = uniform(r, -9.0, 9.0);
       if (p.views.size() < 8) addView(p, view, pick(r, p.views.size() + 1));
     }},
    {"duplicate view",
     [](Project& p, Random& r) {
       if (p.views.size() < 8) duplicateView(p, pick(r, p.views.size()));
     }},
    {"remove view", [](Project& p, Random& r) { removeView(p, pick(r, p.views.size() + 1)); }},
    {"move view",
     [](Project& p, Random& r) {
       const std::size_t from = pick(r, p.views.size());
       moveView(p, from, pick(r, p.views.size() + 1));
     }},
    {"rename view", [](Project& p, Random& r) { renameView(p, pick(r, p.views.size()), "v"); }},
    {"update view",
     [](Project& p, Random& r) {
       scene::View view;
       view.exposureEv = uniform(r, -2.0, 2.0);
       updateView(p, pick(r, p.views.size()), view);
     }},
    {"list lights",
     [](Project& p, Random& r) {
       std::vector<scene::SunAngles> angles(1 + pick(r, 6));
       for (auto& a : angles) a = anyAngles(r);
       convertToList(p, angles);
     }},
    {"light pattern",
     [](Project& p, Random& r) {
       usePattern(p, r() % 4 == 0 ? scene::LightPattern::Fibonacci : scene::LightPattern::List,
                  static_cast<int>(pick(r, 40)));
     }},
    {"add light", [](Project& p, Random& r) { addLight(p, anyAngles(r)); }},
    {"move light",
     [](Project& p, Random& r) {
       const auto angles = anyAngles(r);
       moveLight(p, pick(r, p.lights.directions.size()), angles);
     }},
    {"remove light", [](Project& p, Random& r) { removeLight(p, pick(r, p.lights.directions.size())); }},
    {"relocate",
     [](Project& p, Random&) {
       EXPECT_TRUE(project::relocate(p, "patch.soil.texture", SWARD_SOURCE_DIR "/README.md").ok());
     }},
    {"blade profile", setCurve},
    {"patch size", [](Project& p, Random& r) { p.patch.sideM = uniform(r, 0.5, 3.0); }},
    {"sun", [](Project& p, Random& r) { p.sun.angles.azimuthDeg = uniform(r, 0.0, 360.0); }},
    {"any value", changeAnyField},
};

Project start() {
  Project project = project::fromTemplate("meadow").value();
  project.folder = "/projects/meadow";
  project.patch.soil.texture = "soil.png";
  return project;
}

/// The change of one edit with arguments that depend on `seed` alone, so that it can be applied twice.
Change seeded(const NamedEdit& edit, std::uint64_t seed) {
  return [&edit, seed](Project& project) {
    Random random(seed);
    edit.change(project, random);
  };
}

TEST(History, EveryEditUndoneAndRedoneIsByteEqual) {
  for (const NamedEdit& edit : kEdits) {
    int changes = 0;
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
      Document document(start());
      ASSERT_TRUE(document.edit("lights", [](Project& p) {
        convertToList(p, {{0.0, 30.0}, {120.0, 30.0}, {240.0, 30.0}});
      }));
      const std::string before = toJson(document.project());
      if (!document.edit(edit.name, seeded(edit, seed))) {
        EXPECT_EQ(toJson(document.project()), before) << edit.name;
        continue;
      }
      ++changes;
      const std::string after = toJson(document.project());
      EXPECT_NE(after, before) << edit.name;
      EXPECT_EQ(document.undoName(), edit.name);
      document.undo();
      EXPECT_EQ(toJson(document.project()), before) << edit.name;
      document.redo();
      EXPECT_EQ(toJson(document.project()), after) << edit.name;
    }
    EXPECT_GT(changes, 0) << edit.name << " never changed anything";
  }
}

/// What the document promises, told with texts alone: no snapshots, no shared code.
class Reference {
 public:
  explicit Reference(std::string first) : m_states{std::move(first)} {}

  bool edit(const std::string& name, const Change& change, const std::string& key) {
    Project project = project::parse(now(), "/projects/meadow/meadow.sward").value();
    change(project);
    std::string text = toJson(project);
    if (text == now()) return false;
    if (!key.empty() && key == m_key) {
      m_states[m_position] = std::move(text);
      return true;
    }
    close();
    m_states.resize(m_position + 1);
    m_names.resize(m_position);
    if (m_saved > static_cast<long>(m_position)) m_saved = -1;
    m_states.push_back(std::move(text));
    m_names.push_back(name);
    ++m_position;
    m_key = key;
    return true;
  }
  void close() {
    if (!m_key.empty() && m_states[m_position] == m_states[m_position - 1]) {
      m_states.pop_back();
      m_names.pop_back();
      --m_position;
    }
    m_key.clear();
  }
  void go(long by) {
    close();
    const long last = static_cast<long>(m_states.size()) - 1;
    m_position = static_cast<std::size_t>(std::clamp(static_cast<long>(m_position) + by, 0L, last));
  }
  void save() {
    close();
    m_saved = static_cast<long>(m_position);
  }
  const std::string& now() const { return m_states[m_position]; }
  bool modified() const { return m_saved != static_cast<long>(m_position); }
  std::size_t position() const { return m_position; }
  const std::vector<std::string>& names() const { return m_names; }
  const std::vector<std::string>& states() const { return m_states; }

 private:
  std::vector<std::string> m_states, m_names;
  std::size_t m_position = 0;
  long m_saved = 0;
  std::string m_key;
};

void compare(const Document& document, const Reference& reference, int step) {
  ASSERT_EQ(toJson(document.project()), reference.now()) << "step " << step;
  ASSERT_EQ(document.position(), reference.position()) << "step " << step;
  ASSERT_EQ(document.modified(), reference.modified()) << "step " << step;
  ASSERT_EQ(document.canUndo(), reference.position() > 0);
  ASSERT_EQ(document.canRedo(), reference.position() + 1 < reference.states().size());
}

/// From the last state to the first and back, every one of them.
void walk(Document& document, Reference& reference) {
  document.closeStep();
  reference.close();
  ASSERT_EQ(document.stepNames(), reference.names());
  const std::size_t here = document.position();
  while (document.canRedo()) document.redo();
  for (std::size_t i = reference.states().size(); i-- > 0;) {
    ASSERT_EQ(toJson(document.project()), reference.states()[i]) << "undone to " << i;
    document.undo();
  }
  ASSERT_FALSE(document.canUndo());
  for (const std::string& state : reference.states()) {
    ASSERT_EQ(toJson(document.project()), state);
    document.redo();
  }
  document.goTo(here);
}

/// One edit; drags hold the same value of one edit open, and now and then come back to where they began.
void randomEdit(Document& document, Reference& reference, Random& random, int step) {
  const NamedEdit& edit = kEdits[pick(random, std::size(kEdits))];
  const bool merges = random() % 2 == 0;
  const std::string key = merges ? edit.name : "";
  const std::string before = reference.now();
  const int moves = merges ? 1 + static_cast<int>(random() % 4) : 1;
  for (int i = 0; i < moves; ++i) {
    const bool comesBack = i > 0 && i + 1 == moves && random() % 2 == 0;
    const Change change =
        comesBack ? Change([&](Project& p) { p = project::parse(before, "/projects/meadow/meadow.sward").value(); })
                  : seeded(edit, random());
    ASSERT_EQ(document.edit(edit.name, change, key), reference.edit(edit.name, change, key))
        << edit.name << ", step " << step;
  }
}

TEST(History, TenThousandRandomEditsWithUndoAndRedo) {
  Random random(20240611);
  Document document(start(), "/projects/meadow/meadow.sward");
  Reference reference(toJson(start()));
  int edits = 0, undone = 0, redone = 0;
  for (int step = 0; edits < 10000; ++step) {
    const auto action = random() % 100;
    if (action < 60) {
      ++edits;
      randomEdit(document, reference, random, step);
    } else if (action < 77) {
      undone += document.canUndo();
      document.undo(), reference.go(-1);
    } else if (action < 90) {
      redone += document.canRedo();
      document.redo(), reference.go(+1);
    } else if (action < 94) {
      document.markSaved(document.file()), reference.save();
    } else if (action < 99) {
      document.closeStep(), reference.close();
    } else {
      const std::size_t back = pick(random, 20);
      reference.close();
      const std::size_t to = reference.position() - std::min(back, reference.position());
      document.goTo(to), reference.go(static_cast<long>(to) - static_cast<long>(reference.position()));
    }
    ASSERT_NO_FATAL_FAILURE(compare(document, reference, step));
    if (step % 8000 == 0) {
      ASSERT_NO_FATAL_FAILURE(walk(document, reference));
    }
  }
  ASSERT_NO_FATAL_FAILURE(walk(document, reference));
  // The sequence is a test only if it went everywhere.
  EXPECT_GT(undone, 1000);
  EXPECT_GT(redone, 300);
  EXPECT_GT(reference.states().size(), 500u);
}

}  // namespace
}  // namespace sward::editor
