// SPDX-License-Identifier: Apache-2.0
#include "toolkit/program/Interrupt.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

#include <sys/wait.h>
#include <unistd.h>

namespace filament_core::tools {
namespace {

/// How a process that runs `work` ends.
template <class Work>
int endOf(Work&& work) {
    const pid_t child = ::fork();
    if (child == 0) {
        watchForInterrupts();
        work();
        std::_Exit(0);
    }
    int status = 0;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    return status;
}

void workUntilInterrupted() {
    while (!isInterrupted()) ::usleep(1000);
}

TEST(Interrupt, TheFirstOneStopsTheWorkAndTheProcessReportsIt) {
    for (const int signal : { SIGINT, SIGTERM }) {
        const int status = endOf([&] {
            const StopOnInterrupt scope;
            std::raise(signal);
            workUntilInterrupted();
            std::_Exit(kInterruptedStatus);
        });
        EXPECT_TRUE(WIFEXITED(status));
        EXPECT_EQ(WEXITSTATUS(status), 130);
    }
}

TEST(Interrupt, TheSecondOneEndsTheProcess) {
    const int status = endOf([] {
        const StopOnInterrupt scope;
        std::raise(SIGINT);
        std::raise(SIGINT);
    });
    EXPECT_TRUE(WIFSIGNALED(status));
    EXPECT_EQ(WTERMSIG(status), SIGINT);
}

TEST(Interrupt, OutsideOfAScopeTheFirstOneEndsTheProcess) {
    const int status = endOf([] {
        { const StopOnInterrupt scope; }
        std::raise(SIGTERM);
    });
    EXPECT_TRUE(WIFSIGNALED(status));
    EXPECT_EQ(WTERMSIG(status), SIGTERM);
}

TEST(Interrupt, WhatTheParentIgnoresStaysIgnored) {
    const auto before = std::signal(SIGINT, SIG_IGN);
    const int status = endOf([] { std::raise(SIGINT); });
    std::signal(SIGINT, before);
    EXPECT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 0);
}

} // namespace
} // namespace filament_core::tools
