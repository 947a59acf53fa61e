#pragma once

#include "base/result.h"

#include <exception>
#include <new>
#include <string>
#include <utility>

namespace sward::image {

/// Runs `body` and turns what OpenImageIO and the libraries under it throw into an Error about `name`.
template <typename Body>
auto withoutExceptions(const std::string& name, const std::string& remedy, Body&& body) -> decltype(body()) {
  try {
    return std::forward<Body>(body)();
  } catch (const std::bad_alloc&) {
    return Error::failed("there is not enough memory for the image", name, "Use a smaller image.");
  } catch (const std::exception& problem) {
    return Error::badInput(std::string("the image library refused it: ") + problem.what(), name, remedy);
  }
}

}  // namespace sward::image
