#include "formats/core/result.h"

namespace oriel {

Error::Error() = default;
Error::Error(ErrorCode of, std::string said, std::string at)
    : code(of), message(std::move(said)), where(std::move(at)) {}
Error::Error(const Error&) = default;
Error::Error(Error&&) noexcept = default;
Error& Error::operator=(const Error&) = default;
Error& Error::operator=(Error&&) noexcept = default;
Error::~Error() = default;

std::string Error::text() const {
  return where.empty() ? message : where + ": " + message;
}

tl::unexpected<Error> failed(ErrorCode code, std::string where, fmt::string_view format, fmt::format_args args) {
  return tl::unexpected<Error>(Error(code, fmt::vformat(format, args), std::move(where)));
}

}  // namespace oriel
