// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "apps/viewer/run_folder.hpp"

#include <optional>
#include <string>

namespace plekton::apps {

/// The frame nearest to a time; the last one if there is none asked for.
/// @throws InputError if the run has no frames, or ends before that time
const FrameFiles& frame_at(const RunFolder& run, std::optional<double> time);

/// The bytes of a picture (PNG) of a frame, by pvbatch of ParaView, and by xvfb-run where there is no
/// screen. @throws InputError if these are not installed or fail
std::string rendered_frame(const RunFolder& run, const FrameFiles& frame);

}  // namespace plekton::apps
