#pragma once

#include <string_view>

namespace sward::report {

/// The files of core/report/assets/, built into the program.

/// Rules for the plots of plot_svg.h, alone and in a page: colours for light and dark (prefers-color-scheme). Seven
/// colours of Okabe and Ito 2008 that people with any form of colour blindness tell apart, less the yellow that
/// vanishes on white. No '<' or '&', so that they may stand in XML as they are.
std::string_view plotStyle();
/// Rules for the rest of the page.
std::string_view pageStyle();
/// Sorts tables and enlarges pictures; the page can be read without.
std::string_view pageScript();

}  // namespace sward::report
