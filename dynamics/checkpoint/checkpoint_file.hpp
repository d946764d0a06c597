// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dynamics/checkpoint/checkpoint_error.hpp"
#include "geometry/base/state_tree.hpp"

#include <filesystem>
#include <string>
#include <string_view>

/// Checkpoints: the state of a simulation in one HDF5 file.
///
/// Every array of the state is a data set of its name, of rows and columns, of 64-bit floating
/// point numbers or signed integers of 64 or 32 or unsigned ones of 8 bits, little-endian. In the
/// 512 bytes before what HDF5 reads (its user block) stand lines of text: `plekton checkpoint`,
/// `version` (kCheckpointVersion), `writer` (the version of Plekton), `bytes` and `checksum` of the
/// rest, `revision` (of the program that wrote it; "unknown" where none was told). A file in which a bit has changed is refused. The same state makes the same bytes.
namespace plekton::dynamics {

/// Grows whenever an array of the state changes its name or meaning.
constexpr int kCheckpointVersion = 15;

inline constexpr std::string_view kUnknownRevision = "unknown";

/// Writes a file beside the place and renames it: there is a whole checkpoint or the one of before
/// at any moment, also after a power cut: it returns when the file is on the disk.
/// @param revision  of the program, one line
/// @throws OutputError
void write_checkpoint(const std::filesystem::path& file, const geometry::StateTree& state,
                      std::string_view revision = kUnknownRevision);

/// Whether a file that begins so is a checkpoint, of any version.
bool is_checkpoint(std::string_view head);

/// Who wrote a checkpoint.
struct CheckpointWriter {
  std::string version;   ///< of Plekton
  std::string revision;  ///< of the program
};
/// Reads no more than the head of the file. @throws CheckpointError as read_checkpoint(), but for
/// what is damaged behind the head
CheckpointWriter writer_of_checkpoint(const std::filesystem::path& file);

/// @throws CheckpointError if there is no such file, it is no checkpoint, of another version, or
///         damaged. No more memory is taken than the file has bytes, times two.
geometry::StateTree read_checkpoint(const std::filesystem::path& file);

/// The same from memory. @param name  what messages call it
geometry::StateTree parse_checkpoint(std::string bytes, const std::filesystem::path& name);

}  // namespace plekton::dynamics
