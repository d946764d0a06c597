// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace plekton::apps {

/// What the program answers to its caller.
enum ExitCode : int {
  kDone = 0,
  kFailed = 1,        ///< a problem of the input or the run
  kUsage = 2,         ///< a command line that cannot be understood
  kRed = 3,           ///< with --strict: a run that is doubtful, with complete files
  kInterrupted = 130  ///< by Ctrl-C or a request to end, with complete files
};

}  // namespace plekton::apps
