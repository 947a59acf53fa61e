#pragma once

#include "report/report.h"
#include "report/section.h"

#include <vector>

namespace sward::report::test {

/// Text that breaks whatever forgets to escape it: markup, quotes, umlauts, an end of the script, bytes that are no
/// UTF-8, and a control character.
extern const char* const kHostile;

ReportHead exampleHead();
/// Two sections of invented figures with all that a section can hold: "lpt_fit" with ten methods under two suns, plots,
/// a strip, tables and arrays, and "speed" with a few unlike rows. Not measured anywhere.
std::vector<Section> exampleSections();
/// The same with kHostile in every text for people.
std::vector<Section> hostileSections();

}  // namespace sward::report::test
