#include "formats/core/file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>

namespace oriel {
namespace fs = std::filesystem;

namespace {

// By the system's error.
tl::unexpected<Error> failed(const fs::path& path, const char* what) {
  return fail(ErrorCode::kIo, path.string(), "{}: {}", what, std::strerror(errno));
}

Status check_file(const fs::path& path) {
  std::error_code ec;
  const auto status = fs::status(path, ec);
  if (!fs::exists(status)) return fail(ErrorCode::kIo, path.string(), "no such file");
  if (fs::is_directory(status)) return fail(ErrorCode::kIo, path.string(), "is a directory, expected a file");
  return {};
}

bool all_zero(std::span<const std::byte> bytes) {
  return bytes.empty() ||
         (bytes[0] == std::byte{0} && std::memcmp(bytes.data(), bytes.data() + 1, bytes.size() - 1) == 0);
}

}  // namespace

Result<Bytes> read_file(const fs::path& path, std::uint64_t max_bytes) {
  ORIEL_TRY_VOID(check_file(path));
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

Result<AtomicFile> AtomicFile::create(const fs::path& path) {
  const int fd = ::open(temporary_name(path).c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (fd < 0) return fail(ErrorCode::kIo, path.string(), "cannot be written: {}", std::strerror(errno));
  return AtomicFile(path, fd);
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : path_(std::exchange(other.path_, {})), fd_(std::exchange(other.fd_, -1)), size_(other.size_) {}

AtomicFile::~AtomicFile() {
  if (fd_ >= 0) ::close(fd_);
  if (!path_.empty()) ::unlink(temporary_name(path_).c_str());
}

Status AtomicFile::write(std::uint64_t offset, std::span<const std::byte> bytes) {
  const bool hole = offset >= size_ && all_zero(bytes);
  for (std::size_t done = 0; done < bytes.size() && !hole;) {
    const ssize_t n = ::pwrite(fd_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(offset + done));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return failed(path_, "cannot be written to its end");
    done += static_cast<std::size_t>(n);
  }
  size_ = std::max(size_, offset + bytes.size());
  return {};
}

Status AtomicFile::commit() {
  if (::ftruncate(fd_, static_cast<off_t>(size_)) != 0) return failed(path_, "cannot be written to its end");
  if (::fsync(fd_) != 0) return failed(path_, "cannot be flushed to disk");
  if (::close(std::exchange(fd_, -1)) != 0) return failed(path_, "cannot be flushed to disk");
  if (::rename(temporary_name(path_).c_str(), path_.c_str()) != 0) return failed(path_, "cannot be renamed into place");
  path_.clear();
  return {};
}

fs::path lock_name(const fs::path& path) {
  return path.string() + ".lock";
}

Result<OutputLock> OutputLock::take(const fs::path& path) {
  const fs::path file = lock_name(path);
  for (;;) {
    const int fd = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (fd < 0) return OutputLock({}, -1);  // whoever writes tells why not
    OutputLock lock(file, fd);
    if (::flock(fd, LOCK_EX | LOCK_NB) != 0) {
      if (errno != EWOULDBLOCK) return lock;
      char pid[32] = "";
      [[maybe_unused]] const ssize_t told = ::pread(fd, pid, sizeof(pid) - 1, 0);
      lock.path_.clear();
      return fail(ErrorCode::kIo, path.string(), "is being written by {}: wait for it, or end it",
                  *pid != '\0' ? fmt::format("process {}", pid) : "another process");
    }
    // It may have been another's that ended just now, and removed it.
    struct stat held {
    }, there{};
    if (::fstat(fd, &held) == 0 && ::stat(file.c_str(), &there) == 0 && held.st_ino == there.st_ino) {
      const std::string pid = std::to_string(::getpid());
      [[maybe_unused]] const bool told = ::ftruncate(fd, 0) == 0 && ::pwrite(fd, pid.data(), pid.size(), 0) > 0;
      return lock;
    }
    lock.path_.clear();
  }
}

OutputLock::~OutputLock() {
  if (fd_ < 0) return;
  if (!path_.empty()) ::unlink(path_.c_str());
  ::close(fd_);
}

Status write_file_atomically(const fs::path& path, std::span<const std::byte> bytes) {
  ORIEL_TRY(AtomicFile file, AtomicFile::create(path));
  ORIEL_TRY_VOID(file.write(0, bytes));
  return file.commit();
}

Status write_text_atomically(const fs::path& path, std::string_view text) {
  return write_file_atomically(path, std::as_bytes(std::span(text)));
}

Result<MappedFile> MappedFile::open(const fs::path& path) {
  ORIEL_TRY_VOID(check_file(path));
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return failed(path, "cannot be opened for reading");
  struct stat status {};
  const bool known = ::fstat(fd, &status) == 0;
  const auto size = static_cast<std::size_t>(status.st_size);
  void* const at = known && size > 0 ? ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, fd, 0) : nullptr;
  const int reason = errno;
  ::close(fd);  // the mapping stays
  errno = reason;
  if (!known || at == MAP_FAILED) return failed(path, "cannot be mapped");
  if (at) ::madvise(at, size, MADV_SEQUENTIAL);
  return MappedFile({static_cast<const std::byte*>(at), size});
}

MappedFile::~MappedFile() {
  if (!bytes_.empty()) ::munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

Result<OpenFile> OpenFile::open(const fs::path& path) {
  ORIEL_TRY_VOID(check_file(path));
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return failed(path, "cannot be opened for reading");
  OpenFile file(path, fd, 0);
  struct stat status {};
  if (::fstat(fd, &status) != 0) return failed(path, "cannot be read");
  file.size_ = static_cast<std::uint64_t>(status.st_size);
  return file;
}

OpenFile::~OpenFile() {
  if (fd_ >= 0) ::close(fd_);
}

Status OpenFile::read(std::uint64_t offset, std::span<std::byte> to) const {
  for (std::size_t done = 0; done < to.size();) {
    const ssize_t n = ::pread(fd_, to.data() + done, to.size() - done, static_cast<off_t>(offset + done));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0)
      return fail(ErrorCode::kIo, path_.string(), "cannot be read at byte {}: {}", offset + done, std::strerror(errno));
    if (n == 0)
      return fail(ErrorCode::kIo, path_.string(),
                  "found no byte {}, expected {} bytes from byte {}: the file was cut since it was opened",
                  offset + done, to.size(), offset);
    done += static_cast<std::size_t>(n);
  }
  return {};
}

Status print(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    return fail(ErrorCode::kIo, "stdout", "cannot be written: {}", std::strerror(errno));
  return {};
}

}  // namespace oriel
