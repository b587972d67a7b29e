// SPDX-License-Identifier: Apache-2.0
/// ChildProcess: a program that runs beside this one, in an environment of its own.
///   In      words (the first is looked for in PATH), variables that go over those of this process, a file for its
///           standard output and error.
///   Out     how it ended. A crash of the child is an answer, never an end of this process.
///   Life    the destructor kills and waits for what still runs.
///   Thread  one.
///   Fails   NotFound or Unreadable if it cannot be started; one line that names program or file.
#pragma once

#include "base/Result.h"

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace filament::tools {

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

    /// Does not wait; nothing while it runs. Not after it gave an answer.
    std::optional<ChildEnd> poll();
    /// SIGKILL; the end is that of the signal, unless the child was faster.
    ChildEnd kill();

private:
    explicit ChildProcess(pid_t id) : mId(id) {}
    ChildEnd ended(int status);

    pid_t mId = -1; ///< -1: none, or it has ended
};

} // namespace filament::tools
