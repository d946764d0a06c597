// SPDX-License-Identifier: GPL-3.0-or-later
#include "dynamics/output/file.hpp"

#include "geometry/base/new_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

namespace plekton::dynamics {
namespace {

std::string_view advice(int reason) noexcept {
  switch (reason) {
    case ENOSPC:
    case EDQUOT:
      return "free some space or choose an output folder on another disk";
    case EFBIG:
      return "raise the limit of file sizes (ulimit -f) or choose an output folder on another disk";
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose an output folder that you may write to";
    case ENOENT:
      return "check that its folder exists";
    case ENOTDIR:
      return "a part of the path is a file; choose another output folder";
    case ELOOP:
      return "a link has this name; remove it or choose another output folder";
    case EEXIST:
      return "something that is no file has this name; remove it or choose another output folder";
    case EISDIR:
      return "a folder has this name; remove it or choose another output folder";
    case ENAMETOOLONG:
      return "choose a shorter name";
    case EMFILE:
    case ENFILE:
      return "raise the limit of open files (ulimit -n)";
    case EIO:
      return "check the disk and its connection";
    default:
      return "check the output folder";
  }
}

std::string system_message(const std::filesystem::path& file, std::string_view action, int reason) {
  std::string message = file.string();
  message.append(": cannot ").append(action).append(": ");
  message.append(std::generic_category().message(reason));
  message.append("; ").append(advice(reason));
  return message;
}

void create_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directory(folder, error);
  if (!error) return;
  const std::filesystem::path parent = folder.parent_path();
  std::error_code unknown;
  if (error.value() == ENOENT && !parent.empty() && !std::filesystem::exists(parent, unknown)) {
    throw OutputError(folder, "cannot create the folder: its parent " + parent.string() +
                                  " does not exist; create that first or correct the path");
  }
  throw OutputError(folder, "create the folder", error.value());
}

constexpr std::string_view kProbe = "Plekton was here to see if it can write.\n";

/// Into a file without a name, which is gone however the program ends. @returns whether the file
/// system knows such files
bool write_nameless_probe(const std::filesystem::path& folder) {
  const int file = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);
  if (file < 0 && (errno == EOPNOTSUPP || errno == EISDIR || errno == EINVAL)) return false;
  int reason = file < 0 ? errno : 0;
  if (file >= 0) {
    const ssize_t written = ::write(file, kProbe.data(), kProbe.size());
    if (written < 0) reason = errno;
    if (written >= 0 && written < static_cast<ssize_t>(kProbe.size())) reason = ENOSPC;
    ::close(file);
  }
  if (reason != 0) throw OutputError(folder, "write into the folder", reason);
  return true;
}

void write_probe(const std::filesystem::path& folder) {
  if (write_nameless_probe(folder)) return;
  // The process id keeps runs apart that start into the same folder at the same time.
  const std::filesystem::path probe =
      folder / (".plekton-write-test-" + std::to_string(::getpid()));
  try {
    OutputFile file(probe);
    file.write(kProbe);
    file.commit();
  } catch (const OutputError& error) {
    throw OutputError(folder, "write into the folder", error.reason());
  }
  std::error_code ignored;
  std::filesystem::remove(probe, ignored);
}

int opened(const std::filesystem::path& path, CheckedFile::Mode mode) {
  if (goes_nowhere(path)) return ::open(kNowhere.data(), O_WRONLY | O_CLOEXEC);
  if (mode == CheckedFile::Mode::create) return geometry::create_new_file(path);
  // Where bytes go is said by each write_at(), but not heeded in a file that is appended to.
  const int at_the_end = mode == CheckedFile::Mode::append ? O_APPEND : 0;
  return ::open(path.c_str(), O_WRONLY | O_NOFOLLOW | O_CLOEXEC | at_the_end);
}

/// Where a file is written that is to have this name.
std::filesystem::path part_in_place_of(const std::filesystem::path& path) {
  if (!goes_nowhere(path) && geometry::is_no_file(path))
    throw OutputError(path, "is a device, pipe or socket, no file; choose another name");
  return geometry::part_of(path);
}

}  // namespace

bool goes_nowhere(const std::filesystem::path& file) {
  const std::string_view path = file.native();
  return path.starts_with(kNowhere) &&
         (path.size() == kNowhere.size() || path[kNowhere.size()] == '/');
}

OutputError::OutputError(const std::filesystem::path& file, std::string_view action, int reason)
    : std::runtime_error(system_message(file, action, reason)), reason_(reason) {}

OutputError::OutputError(const std::filesystem::path& file, std::string_view problem)
    : std::runtime_error(file.string().append(": ").append(problem)) {}

CheckedFile::CheckedFile(std::filesystem::path path, Mode mode)
    : path_(std::move(path)), descriptor_(opened(path_, mode)) {
  if (descriptor_ < 0) throw OutputError(path_, mode == Mode::create ? "create" : "open", errno);
  struct stat status {};
  if (::fstat(descriptor_, &status) == 0) size_ = status.st_size;
}

CheckedFile::~CheckedFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void CheckedFile::write(std::string_view bytes) {
  assert(descriptor_ >= 0 && "written to after close()");
  std::string_view rest = bytes;
  while (!rest.empty()) {
    const ssize_t written = ::write(descriptor_, rest.data(), rest.size());
    if (written > 0) {
      rest.remove_prefix(static_cast<std::size_t>(written));
      continue;
    }
    const int reason = written < 0 ? errno : EIO;
    if (reason == EINTR) continue;
    std::ignore = ::ftruncate(descriptor_, size_);
    throw OutputError(path_, "write", reason);
  }
  size_ += static_cast<std::int64_t>(bytes.size());
}

void CheckedFile::write_at(std::size_t position, std::string_view bytes) {
  assert(descriptor_ >= 0 && "written to after close()");
  while (!bytes.empty()) {
    const ssize_t written =
        ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(position));
    const int reason = written < 0 ? errno : EIO;
    if (written < 0 && reason == EINTR) continue;
    if (written <= 0) throw OutputError(path_, "write", reason);
    position += static_cast<std::size_t>(written);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void CheckedFile::close() {
  if (descriptor_ < 0) return;
  // The descriptor is gone even after an error, also after EINTR.
  if (::close(std::exchange(descriptor_, -1)) != 0 && errno != EINTR) {
    throw OutputError(path_, "finish writing", errno);
  }
}

OutputFile::OutputFile(const std::filesystem::path& path)
    : path_(path), part_(part_in_place_of(path)), file_(part_, CheckedFile::Mode::create) {}

OutputFile::~OutputFile() {
  if (committed_) return;
  std::error_code ignored;
  std::filesystem::remove(part_, ignored);
}

void OutputFile::commit() {
  file_.close();
  committed_ = goes_nowhere(path_);
  if (committed_) return;
  std::error_code error;
  std::filesystem::rename(part_, path_, error);
  if (error) throw OutputError(path_, "give the finished file its name", error.value());
  committed_ = true;
}

void overwrite(const std::filesystem::path& path, std::span<const PlacedBytes> writes) {
  CheckedFile file(path, CheckedFile::Mode::replace_bytes);
  for (const PlacedBytes& write : writes) file.write_at(write.position, write.bytes);
  file.close();
}

void cut_back(const std::filesystem::path& file, std::uint64_t kept) {
  std::error_code error;
  std::filesystem::resize_file(file, kept, error);
  if (error) throw OutputError(file, "cut the file back to where the run goes on", error.value());
}

void ensure_output_folder(const std::filesystem::path& folder) {
  if (goes_nowhere(folder)) return;
  if (folder.empty()) throw OutputError(folder, "the output folder has no name; choose one");
  // "out/" names the same folder as "out", but its parent path would be "out".
  const std::filesystem::path path = folder.has_filename() ? folder : folder.parent_path();
  std::error_code ignored;
  const std::filesystem::file_status before = std::filesystem::status(path, ignored);
  const bool existed = std::filesystem::exists(before);
  if (existed && !std::filesystem::is_directory(before)) {
    throw OutputError(path, "is a file, not a folder; remove it or choose another output folder");
  }
  if (!existed) create_folder(path);
  try {
    write_probe(path);
  } catch (const OutputError&) {
    if (!existed) std::filesystem::remove(path, ignored);
    throw;
  }
}

}  // namespace plekton::dynamics
