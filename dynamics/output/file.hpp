// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace plekton::dynamics {

/// A folder whose files go nowhere: of processes that compute with others, and leave it to one of
/// them to write.
inline constexpr std::string_view kNowhere = "/dev/null";

/// Whether a file is in that folder, or below it.
bool goes_nowhere(const std::filesystem::path& file);

/// A result could not be written. The message names the file, the reason of the operating system,
/// and what to do.
class OutputError : public std::runtime_error {
 public:
  /// @param action  What was tried, as in "cannot <action>".
  /// @param reason  errno of the failed call.
  OutputError(const std::filesystem::path& file, std::string_view action, int reason);
  /// @param problem  What is wrong and what to do, for a reason that is not the operating system's.
  OutputError(const std::filesystem::path& file, std::string_view problem);

  /// errno of the failed call; 0 if no call failed.
  int reason() const noexcept { return reason_; }

 private:
  int reason_ = 0;
};

/// An open file whose every write is checked. It has no buffer, so hand over whole lines or blocks.
class CheckedFile {
 public:
  enum class Mode : std::uint8_t {
    create,        ///< a new file, as geometry::create_new_file() makes it
    append,        ///< to a file that is there; a link is not followed
    replace_bytes  ///< of a file that is there, by write_at() alone; likewise
  };

  /// @throws OutputError
  CheckedFile(std::filesystem::path path, Mode mode);
  CheckedFile(const CheckedFile&) = delete;
  CheckedFile& operator=(const CheckedFile&) = delete;
  /// Closes without a check: call close() to hear of an error that shows only then (network and
  /// quota file systems).
  ~CheckedFile();

  /// Writes all bytes or, as far as the operating system allows, none: after an error the file is
  /// cut back to its size before the call, so that the write can be tried again. @throws
  /// OutputError
  void write(std::string_view bytes);

  /// Writes all bytes over those at a position. After an error some may be written. @throws
  /// OutputError
  void write_at(std::size_t position, std::string_view bytes);

  /// No effect the second time. @throws OutputError
  void close();

 private:
  std::filesystem::path path_;
  int descriptor_;
  std::int64_t size_ = 0;  // bytes
};

/// A result file that appears complete or not at all: written as `NAME.part` and renamed by
/// commit(). Without commit() the destructor removes the part file, and a file of that name from
/// before stays as it was. Two of the same name at the same time disturb each other.
class OutputFile {
 public:
  /// @throws OutputError
  explicit OutputFile(const std::filesystem::path& path);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  /// Unbuffered, see CheckedFile. @throws OutputError
  void write(std::string_view bytes) { file_.write(bytes); }

  /// Closes the part file and gives it its name, replacing a file that has it. Call once, last.
  /// @throws OutputError
  void commit();

 private:
  std::filesystem::path path_;
  std::filesystem::path part_;
  CheckedFile file_;
  bool committed_ = false;
};

/// Bytes and where they go in a file.
struct PlacedBytes {
  std::size_t position;
  std::string bytes;
};

/// Overwrites bytes within a file that is there, one after the other; its size stays if they lie
/// within it. A link is not followed. @throws OutputError, and what came before the error is
/// written
void overwrite(const std::filesystem::path& path, std::span<const PlacedBytes> writes);

/// Cuts a file back to its first bytes. @throws OutputError
void cut_back(const std::filesystem::path& file, std::uint64_t kept);

/// Creates a folder if absent (not its parents) and makes sure that it takes files, by writing one
/// and removing it. A folder created in vain is removed again.
/// @throws OutputError if it has no name, is a file, its parent is missing, or it cannot be written
/// to.
void ensure_output_folder(const std::filesystem::path& folder);

}  // namespace plekton::dynamics
