#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace sward::editor {

/// How a stored number is shown: 0.4 metres as "40 cm", 0.15 as "15 %", 50 degrees as "50°".
struct DisplayUnit {
  std::string suffix;      ///< "cm"; empty for plain numbers
  bool attached = false;   ///< no space before the suffix: "50°"
  double perStored = 1.0;  ///< shown = stored * perStored
};

/// The unit that suits a value of about `typical` (stored) in the schema's unit, such as "m", "degrees", "plants/m2".
/// Metres become cm below 1 and mm below 0.01, so that a field keeps one unit whatever it is set to.
DisplayUnit displayUnit(std::string_view schemaUnit, double typical, bool percent = false);

/// Rounds away what binary fractions add: 41.2 / 100 is 0.412 then.
double cleaned(double value);

/// The number alone, with about four significant digits and no trailing zeros: "40", "0.125". Infinities and NaN read
/// as "inf" and "nan".
std::string shownNumber(double stored, const DisplayUnit& unit);
/// The number with its unit: "40 cm".
std::string shownValue(double stored, const DisplayUnit& unit);
/// Every digit that the value holds, with its unit; what an entry field starts with.
std::string exactValue(double stored, const DisplayUnit& unit);

/// Reads typed text. A bare number is in the shown unit; any other unit of the same kind converts: "12 cm", "0.12m",
/// "5 in", "30%", "1.2 rad". A comma is a decimal point. Nothing when it is no finite number or the unit does not fit.
std::optional<double> parsedValue(std::string_view text, std::string_view schemaUnit, const DisplayUnit& shown);

}  // namespace sward::editor
