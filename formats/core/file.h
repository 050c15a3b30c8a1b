// Whole files in and out.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>
#include <utility>

#include "formats/core/bytes.h"
#include "formats/core/result.h"

namespace oriel {

// The bytes of a regular file. Error kIo when it is missing, a directory, unreadable, or larger than max_bytes.
Result<Bytes> read_file(const std::filesystem::path& path, std::uint64_t max_bytes = std::uint64_t{1} << 40);

// The name under which write_file_atomically writes first, for who must remove it after a kill.
std::filesystem::path temporary_name(const std::filesystem::path& path);

// A file that appears whole: it grows under a temporary name beside path, and commit() flushes it to disk and renames
// it, so that path holds either the old file or the whole new one. What is not committed is removed. Every Status is
// kIo with the reason of the system.
class AtomicFile {
 public:
  static Result<AtomicFile> create(const std::filesystem::path& path);
  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&&) = delete;
  ~AtomicFile();

  // Bytes from offset on; bytes in between that nobody writes are 0. Zeros that reach beyond what was written before
  // may become a hole, which takes no room on the disk.
  Status write(std::uint64_t offset, std::span<const std::byte> bytes);
  Status commit();

 private:
  AtomicFile(const std::filesystem::path& path, int fd) : path_(path), fd_(fd) {}

  std::filesystem::path path_;  // empty: committed or moved from
  int fd_ = -1;
  std::uint64_t size_ = 0;
};

// The same at once.
Status write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);
Status write_text_atomically(const std::filesystem::path& path, std::string_view text);

// Who writes `path`: one process at a time, by a file beside it that the system unlocks however its process ends.
std::filesystem::path lock_name(const std::filesystem::path& output);
class OutputLock {
 public:
  // Error kIo where another process holds it, which is named. Where the file system has no locks there is none.
  static Result<OutputLock> take(const std::filesystem::path& path);
  OutputLock(OutputLock&& other) noexcept : path_(std::move(other.path_)), fd_(std::exchange(other.fd_, -1)) {}
  OutputLock& operator=(OutputLock&&) = delete;
  ~OutputLock();

 private:
  OutputLock(std::filesystem::path path, int fd) : path_(std::move(path)), fd_(fd) {}
  std::filesystem::path path_;
  int fd_ = -1;
};

// The bytes of a file as they lie in the system's file cache: none is read before somebody looks at it, and none is
// copied. The file must keep its length while it is mapped, as files that are replaced by renaming do.
class MappedFile {
 public:
  // Error kIo where path is missing, no regular file or unreadable.
  static Result<MappedFile> open(const std::filesystem::path& path);
  MappedFile(MappedFile&& other) noexcept : bytes_(std::exchange(other.bytes_, {})) {}
  MappedFile& operator=(MappedFile&&) = delete;
  ~MappedFile();

  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  explicit MappedFile(std::span<const std::byte> bytes) : bytes_(bytes) {}
  std::span<const std::byte> bytes_;
};

// A file that stays open and is read in pieces, from any thread. Where somebody cuts or overwrites it meanwhile,
// reading gives an error or other bytes; looking at a mapping would end the program.
class OpenFile {
 public:
  // Error kIo where path is missing, no regular file or unreadable.
  static Result<OpenFile> open(const std::filesystem::path& path);
  OpenFile(OpenFile&& other) noexcept
      : path_(std::move(other.path_)), fd_(std::exchange(other.fd_, -1)), size_(other.size_) {}
  OpenFile& operator=(OpenFile&&) = delete;
  ~OpenFile();

  std::uint64_t size() const { return size_; }  // when it was opened
  const std::filesystem::path& path() const { return path_; }
  // Fills `to` from that offset on. Error kIo where the file is shorter, or the system's.
  Status read(std::uint64_t offset, std::span<std::byte> to) const;

 private:
  OpenFile(std::filesystem::path path, int fd, std::uint64_t size) : path_(std::move(path)), fd_(fd), size_(size) {}
  std::filesystem::path path_;
  int fd_ = -1;
  std::uint64_t size_ = 0;
};

// Text to standard output, flushed. Error kIo.
Status print(std::string_view text);

}  // namespace oriel
