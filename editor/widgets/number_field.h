#pragma once

#include "widgets/units.h"

#include <limits>
#include <string>
#include <string_view>

namespace sward::editor {

/// What one frame of a widget did to its value.
struct EditState {
  bool changed = false;   ///< the value is another one now
  bool finished = false;  ///< the edit that changed it is over: the step of undo ends here
  EditState& operator|=(const EditState& other) {
    changed |= other.changed;
    finished |= other.finished;
    return *this;
  }
};

struct NumberStyle {
  double low = -std::numeric_limits<double>::max();  ///< edits never leave [low, high]
  double high = std::numeric_limits<double>::max();
  double softLow = -std::numeric_limits<double>::max();  ///< what the bar spans and a drag across the field covers;
  double softHigh = std::numeric_limits<double>::max();  ///< extremes mean that there is no such range
  bool logarithmic = false;                              ///< the bar and drags run over decades; softLow > 0 then
  bool bar = true;                                       ///< shows where the value stands in the soft range
  bool whole = false;                                    ///< integers only
  bool faulty = false;                                   ///< drawn as an error: the caller says why
  std::string_view unit;                                 ///< the schema's unit of the stored value
  DisplayUnit shown;                                     ///< how people read it
  const char* caption = "";                              ///< a short name inside the field, such as "X"
};

/// A number that is dragged or typed. Dragging is relative: left and right by the soft range over the field's width
/// (1 % of the value a pixel without a range), Shift ten times finer, Escape takes it back. Double-click, Ctrl-click,
/// Tab or Enter type it, with any unit that parsedValue() knows; text that is no number changes nothing. Values are
/// rounded to what a pixel is worth, so that files hold short numbers.
EditState numberField(const char* id, double& value, const NumberStyle& style, float width);

}  // namespace sward::editor
