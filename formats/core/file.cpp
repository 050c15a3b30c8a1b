#include "formats/core/file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>

namespace oriel {
namespace fs = std::filesystem;

Result<Bytes> read_file(const fs::path& path, std::uint64_t max_bytes) {
  std::error_code ec;
  const auto status = fs::status(path, ec);
  if (!fs::exists(status)) return fail(ErrorCode::kIo, path.string(), "no such file");
  if (fs::is_directory(status)) return fail(ErrorCode::kIo, path.string(), "is a directory, expected a file");
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in) return fail(ErrorCode::kIo, path.string(), "cannot be opened for reading: {}", std::strerror(errno));
  const auto size = static_cast<std::uint64_t>(std::max<std::streamoff>(0, in.tellg()));
  if (size > max_bytes)
    return fail(ErrorCode::kIo, path.string(), "holds {} bytes, at most {} are accepted", size, max_bytes);
  Bytes bytes(size);
  in.seekg(0);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (!in && size > 0) return fail(ErrorCode::kIo, path.string(), "cannot be read to its end ({} bytes)", size);
  return bytes;
}

fs::path temporary_name(const fs::path& path) {
  return path.string() + fmt::format(".tmp-{}", ::getpid());
}

Status write_file_atomically(const fs::path& path, std::span<const std::byte> bytes) {
  const fs::path temporary = temporary_name(path);
  const auto failed = [&](const char* what) -> Status {
    const std::string reason = std::strerror(errno);
    ::unlink(temporary.c_str());
    return fail(ErrorCode::kIo, path.string(), "{}: {}", what, reason);
  };
  const int fd = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (fd < 0) return failed("cannot be written");
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t n = ::write(fd, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) {
      ::close(fd);
      return failed("cannot be written to its end");
    }
    done += static_cast<std::size_t>(n);
  }
  const bool synced = ::fsync(fd) == 0;
  if (::close(fd) != 0 || !synced) return failed("cannot be flushed to disk");
  if (::rename(temporary.c_str(), path.c_str()) != 0) return failed("cannot be renamed into place");
  return {};
}

Status print(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    return fail(ErrorCode::kIo, "stdout", "cannot be written: {}", std::strerror(errno));
  return {};
}

}  // namespace oriel
