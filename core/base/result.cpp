#include "base/result.h"

namespace sward::base {

std::string Error::text() const {
  std::string line;
  if (!where.empty()) line += where + ": ";
  line += what;
  if (!remedy.empty()) {
    if (!line.empty() && line.back() != '.' && line.back() != '!' && line.back() != '?') line += '.';
    line += ' ' + remedy;
  }
  return line;
}

Error Error::failed(std::string what, std::string where, std::string remedy) {
  return {ErrorKind::Failed, std::move(what), std::move(where), std::move(remedy)};
}

Error Error::badInput(std::string what, std::string where, std::string remedy) {
  return {ErrorKind::BadInput, std::move(what), std::move(where), std::move(remedy)};
}

Error Error::cancelled() {
  return {ErrorKind::Cancelled, "cancelled", {}, {}};
}

}  // namespace sward::base
