// SPDX-License-Identifier: Apache-2.0
/// ChildProcess: runs a program as a child process with its own environment.
///   In      words (the first is looked up in PATH), variables that override those of this process, a file for standard
///           output and error.
///   Out     how it ended. A crash of the child is a result and never ends this process.
///   Life    the destructor kills the child if it still runs, and waits for it.
///   Thread  one.
///   Fails   NotFound or Unreadable if it cannot be started; one line that names the program or the file.
#pragma once

#include "base/Result.h"

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace filament_core::tools {

struct ChildCommand {
    std::vector<std::string> words;
    std::vector<std::pair<std::string, std::string>> environment; ///< name, value
    std::filesystem::path log;                                    ///< overwritten
};

struct ChildEnd {
    int exitStatus = 0; ///< if no signal ended it
    int signal = 0;     ///< 0: none
    /// "exit status 1", "signal 11 (Segmentation fault)"
    std::string text() const;
};

class ChildProcess {
public:
    static Result<ChildProcess> start(ChildCommand const& command);
    ChildProcess(ChildProcess&& other) noexcept : mId(std::exchange(other.mId, -1)) {}
    ChildProcess& operator=(ChildProcess&&) = delete;
    ~ChildProcess();

    /// Does not wait; returns nothing while the child runs. Must not be called again after it has returned a result.
    std::optional<ChildEnd> poll();
    pid_t id() const { return mId; } ///< for other signals; -1 after the end
    /// Sends SIGKILL; the result is that of the signal, unless the child ended before.
    ChildEnd kill();

private:
    explicit ChildProcess(pid_t id) : mId(id) {}
    ChildEnd ended(int status);

    pid_t mId = -1; ///< -1: none, or it has ended
};

} // namespace filament_core::tools
