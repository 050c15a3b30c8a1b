// What all ways of reading a pack share: errors of many sections as one, of lacking memory, with the file's name.
#pragma once

#include <functional>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "formats/core/result.h"
#include "formats/pack/validate.h"

namespace oriel {

// work(0) … work(count - 1), side by side where there are many bytes; the error of the first that has one, whatever was
// done first.
Status first_failure(std::size_t count, std::uint64_t bytes, const std::function<Status(std::size_t)>& work);

// The first issue of severity kError.
Status refuse_errors(const std::vector<Issue>& issues);

tl::unexpected<Error> in_file(const std::string& path, Error error);

// What lacks memory gives an error.
template <class Decode>
auto without_exceptions(const Decode& decode) -> decltype(decode()) {
  try {
    return decode();
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::kRuntime, "pack", "there is not enough memory to decode it");
  } catch (const std::length_error&) {
    return fail(ErrorCode::kRuntime, "pack", "there is not enough memory to decode it");
  }
}

}  // namespace oriel
