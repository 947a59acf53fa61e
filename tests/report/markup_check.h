#pragma once

#include <string>
#include <string_view>

namespace sward::report::test {

enum class MarkupKind { Xml, Html };

/// What is wrong with markup, or nothing: tags that do not close in order, attributes without quotes (HTML: bare ones
/// are fine), an '&' that starts no entity, a '<' in text, characters that XML does not have. Html: void elements need
/// no end, and what stands in script and style is skipped to its end tag. Ids must differ, and an address that starts
/// with '#' must be one of them.
std::string markupProblem(std::string_view text, MarkupKind kind);

}  // namespace sward::report::test
