// SPDX-License-Identifier: Apache-2.0
#include "toolkit/program/ChildProcess.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include <csignal>
#include <cstring>
#include <string_view>

extern char** environ;

namespace filament_core::tools {
namespace {

std::vector<std::string> environmentWith(std::vector<std::pair<std::string, std::string>> const& changes) {
    std::vector<std::string> variables;
    for (char** variable = environ; *variable; ++variable) {
        const std::string_view text = *variable;
        const std::string_view name = text.substr(0, text.find('='));
        bool isChanged = false;
        for (auto const& change : changes) isChanged = isChanged || change.first == name;
        if (!isChanged) variables.emplace_back(text);
    }
    for (auto const& [name, value] : changes) variables.push_back(fmt::format("{}={}", name, value));
    return variables;
}

/// Pointers into `words`, terminated by a null pointer.
std::vector<char*> pointersTo(std::vector<std::string>& words) {
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    return pointers;
}

/// Standard output and error go to one file; there is no input.
class Redirection {
public:
    explicit Redirection(std::filesystem::path const& log) {
        posix_spawn_file_actions_init(&mActions);
        posix_spawn_file_actions_addopen(&mActions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_addopen(&mActions, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
        posix_spawn_file_actions_adddup2(&mActions, STDOUT_FILENO, STDERR_FILENO);
    }
    Redirection(Redirection const&) = delete;
    ~Redirection() { posix_spawn_file_actions_destroy(&mActions); }
    posix_spawn_file_actions_t const* get() const { return &mActions; }

private:
    posix_spawn_file_actions_t mActions{};
};

} // namespace

std::string ChildEnd::text() const {
    if (signal != 0) return fmt::format("signal {} ({})", signal, strsignal(signal));
    return fmt::format("exit status {}", exitStatus);
}

Result<ChildProcess> ChildProcess::start(ChildCommand const& command) {
    std::vector<std::string> words = command.words, variables = environmentWith(command.environment);
    const std::vector<char*> arguments = pointersTo(words), environment = pointersTo(variables);
    const Redirection redirection(command.log);
    pid_t id = -1;
    const int error = posix_spawnp(&id, arguments[0], redirection.get(), nullptr, arguments.data(), environment.data());
    if (error != 0)
        return fail(ErrorCode::NotFound, "'{}' cannot be started (output to '{}'): {}", command.words[0],
                    command.log.string(), std::strerror(error));
    return ChildProcess(id);
}

ChildProcess::~ChildProcess() {
    if (mId >= 0) kill();
}

ChildEnd ChildProcess::ended(int status) {
    mId = -1;
    return { WIFEXITED(status) ? WEXITSTATUS(status) : 0, WIFSIGNALED(status) ? WTERMSIG(status) : 0 };
}

std::optional<ChildEnd> ChildProcess::poll() {
    int status = 0;
    if (waitpid(mId, &status, WNOHANG) != mId) return std::nullopt;
    return ended(status);
}

ChildEnd ChildProcess::kill() {
    ::kill(mId, SIGKILL);
    int status = 0;
    while (waitpid(mId, &status, 0) < 0 && errno == EINTR) {
    }
    return ended(status);
}

} // namespace filament_core::tools
