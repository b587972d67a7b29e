// SPDX-License-Identifier: Apache-2.0
#include "toolkit/program/ChildProcess.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <thread>

namespace filament_core::tools {
namespace {

class Child : public testing::Test {
protected:
    void SetUp() override { mLog = std::filesystem::temp_directory_path() / fmt::format("child_{}.txt", ::getpid()); }
    void TearDown() override { std::filesystem::remove(mLog); }

    Result<ChildProcess> start(std::string const& script,
                               std::vector<std::pair<std::string, std::string>> environment = {}) {
        return ChildProcess::start({ { "sh", "-c", script }, std::move(environment), mLog });
    }
    ChildEnd endOf(std::string const& script, std::vector<std::pair<std::string, std::string>> environment = {}) {
        Result<ChildProcess> child = start(script, std::move(environment));
        EXPECT_TRUE(child.ok()) << (child.ok() ? "" : child.error().message);
        for (int i = 0; child && i < 2000; ++i) {
            if (const auto end = child->poll()) return *end;
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        ADD_FAILURE() << "'" << script << "' does not end";
        return {};
    }
    std::string said() const {
        std::ifstream file(mLog);
        return { std::istreambuf_iterator<char>(file), {} };
    }

    std::filesystem::path mLog;
};

TEST_F(Child, TellsItsExitStatusOrTheSignalThatEndedIt) {
    EXPECT_EQ(endOf("exit 0").text(), "exit status 0");
    EXPECT_EQ(endOf("exit 3").exitStatus, 3);
    const ChildEnd crash = endOf("kill -SEGV $$");
    EXPECT_EQ(crash.signal, SIGSEGV);
    EXPECT_EQ(crash.text(), "signal 11 (Segmentation fault)");
}

TEST_F(Child, WritesBothOutputsToTheLogAndHasNothingToRead) {
    endOf("echo one; echo two >&2; cat; echo three");
    EXPECT_EQ(said(), "one\ntwo\nthree\n");
    endOf("echo again");
    EXPECT_EQ(said(), "again\n");
}

TEST_F(Child, HasTheEnvironmentOfItsParentWithTheChangesOverIt) {
    ::setenv("CHILD_TEST_KEPT", "kept", 1);
    ::setenv("CHILD_TEST_CHANGED", "old", 1);
    ::setenv("CHILD_TEST_CHANGED_NOT", "other", 1); // begins like the one that changes
    endOf("echo $CHILD_TEST_KEPT $CHILD_TEST_CHANGED $CHILD_TEST_CHANGED_NOT $CHILD_TEST_NEW",
          { { "CHILD_TEST_CHANGED", "a=b c" }, { "CHILD_TEST_NEW", "new" } });
    EXPECT_EQ(said(), "kept a=b c other new\n");
    EXPECT_STREQ(std::getenv("CHILD_TEST_CHANGED"), "old") << "the parent's own stays";
}

TEST_F(Child, IsGoneWhenItIsKilledOrForgotten) {
    Result<ChildProcess> child = start("exec sleep 1000");
    ASSERT_TRUE(child.ok());
    EXPECT_FALSE(child->poll().has_value());
    EXPECT_EQ(child->kill().signal, SIGKILL);
    const auto begin = std::chrono::steady_clock::now();
    { const Result<ChildProcess> forgotten = start("exec sleep 1000"); }
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(100));
}

TEST_F(Child, ThatCannotStartIsAnErrorWithItsName) {
    const auto child = ChildProcess::start({ { "no-such-program-anywhere" }, {}, mLog });
    ASSERT_FALSE(child.ok());
    EXPECT_EQ(child.error().code, ErrorCode::NotFound);
    EXPECT_NE(child.error().message.find("'no-such-program-anywhere' cannot be started"), std::string::npos);
    EXPECT_FALSE(ChildProcess::start({ { "true" }, {}, "/nowhere/log.txt" }).ok());
}

} // namespace
} // namespace filament_core::tools
