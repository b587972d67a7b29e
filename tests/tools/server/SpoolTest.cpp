// SPDX-License-Identifier: Apache-2.0
// The queue in a folder: order, claims by many threads, ends of processes, restarts, full queues.
#include "tools/server/Spool.h"

#include "tools/server/FolderWatch.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <atomic>
#include <fstream>
#include <set>
#include <thread>

namespace filament_core::server {
namespace {

namespace fs = std::filesystem;

class SpoolTest : public testing::Test {
protected:
    SpoolTest() {
        std::string name = (fs::path(testing::TempDir()) / "spoolXXXXXX").string();
        EXPECT_NE(::mkdtemp(name.data()), nullptr);
        mFolder = name;
    }
    ~SpoolTest() override { fs::remove_all(mFolder); }
    Spool open(uint32_t mostQueued = 1000) {
        Result<Spool> spool = Spool::open(mFolder, mostQueued);
        EXPECT_TRUE(spool);
        return std::move(*spool);
    }
    static Accepted accepted(Spool& spool, std::string const& name, std::string_view request = "{}") {
        const Result<Accepted> result = spool.accept(name, request);
        EXPECT_TRUE(result) << result.error().message;
        return *result;
    }
    static ClaimedJob claimed(Spool& spool) {
        Result<std::optional<ClaimedJob>> job = spool.claim();
        EXPECT_TRUE(job && *job);
        return job && *job ? **job : ClaimedJob{};
    }
    static void finish(Spool& spool, ClaimedJob const& job, std::string_view image) {
        std::ofstream(spool.imageDraft(job), std::ios::binary) << image;
        const Result<void> done = spool.finish(job, { .error = {}, .contentType = "image/png" });
        EXPECT_FALSE(fs::exists(spool.imageDraft(job))) << "it is moved";
        EXPECT_TRUE(done) << done.error().message;
    }

    fs::path mFolder;
};

TEST_F(SpoolTest, AJobGoesFromQueuedToRunningToDone) {
    Spool spool = open();
    EXPECT_EQ(spool.state("one"), JobState::Unknown);
    EXPECT_EQ(accepted(spool, "one", "first"), Accepted::New);
    EXPECT_EQ(spool.state("one"), JobState::Queued);
    EXPECT_EQ(accepted(spool, "one", "again"), Accepted::Known);
    const ClaimedJob job = claimed(spool);
    EXPECT_EQ(job.name, "one");
    EXPECT_EQ(job.request, "first");
    EXPECT_EQ(spool.state("one"), JobState::Running);
    EXPECT_EQ(spool.runningOf(::getpid()), "one");
    EXPECT_FALSE(spool.remove("one"));
    EXPECT_EQ(accepted(spool, "one"), Accepted::Known);
    EXPECT_FALSE(*spool.claim());
    finish(spool, job, "picture");
    EXPECT_EQ(spool.state("one"), JobState::Done);
    EXPECT_EQ(spool.outcome("one")->contentType, "image/png");
    std::ifstream image(spool.imageFile("one"));
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(image), {}), "picture");
    EXPECT_TRUE(spool.remove("one"));
    EXPECT_EQ(spool.state("one"), JobState::Unknown);
    EXPECT_FALSE(fs::exists(spool.imageFile("one")));
}

TEST_F(SpoolTest, OlderJobsAreFirst) {
    Spool spool = open();
    std::vector<std::string> names;
    for (int i = 0; i < 100; ++i) {
        names.push_back(Spool::makeName());
        EXPECT_TRUE(Spool::isName(names.back()));
        EXPECT_EQ(accepted(spool, names.back()), Accepted::New);
    }
    for (std::string const& name : names) EXPECT_EQ(claimed(spool).name, name);
}

TEST_F(SpoolTest, NamesAreLettersDigitsAndDashes) {
    Spool spool = open();
    for (const char* name : { "", "..", "a/b", "a.b", "\xc3\xa4", "a b" }) {
        EXPECT_FALSE(Spool::isName(name)) << name;
        EXPECT_EQ(spool.accept(name, "{}").error().code, ErrorCode::InvalidArgument) << name;
    }
    EXPECT_TRUE(Spool::isName(std::string(64, 'a')));
    EXPECT_FALSE(Spool::isName(std::string(65, 'a')));
}

TEST_F(SpoolTest, AFullQueueTakesNothing) {
    Spool spool = open(2);
    EXPECT_EQ(accepted(spool, "a"), Accepted::New);
    EXPECT_EQ(accepted(spool, "b"), Accepted::New);
    EXPECT_EQ(accepted(spool, "c"), Accepted::Full);
    EXPECT_EQ(accepted(spool, "a"), Accepted::Known) << "a repeated request is no new one";
    (void)claimed(spool);
    EXPECT_EQ(accepted(spool, "c"), Accepted::New);
}

TEST_F(SpoolTest, EachJobIsClaimedOnceByManyThreads) {
    Spool spool = open();
    for (int i = 0; i < 200; ++i) (void)accepted(spool, "job" + std::to_string(i));
    std::atomic<int> count{ 0 };
    std::vector<std::thread> threads;
    for (int i = 0; i < 4; ++i) {
        threads.emplace_back([&] {
            Spool own = open();
            for (;;) {
                const Result<std::optional<ClaimedJob>> job = own.claim();
                ASSERT_TRUE(job);
                if (!*job) return;
                ++count;
                finish(own, **job, "x");
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(count, 200);
    EXPECT_EQ(spool.queuedCount() + spool.runningCount(), 0u);
    for (int i = 0; i < 200; ++i) EXPECT_EQ(spool.state("job" + std::to_string(i)), JobState::Done);
}

TEST_F(SpoolTest, AJobOfAProcessThatEndsIsTriedAgainAndThenFails) {
    Spool spool = open();
    (void)accepted(spool, "bad");
    (void)claimed(spool);
    ASSERT_TRUE(spool.release(::getpid() + 1, true, 2, "another process", 500));
    EXPECT_EQ(spool.state("bad"), JobState::Running);
    ASSERT_TRUE(spool.release(::getpid(), true, 2, "it crashed", 500));
    EXPECT_EQ(spool.state("bad"), JobState::Queued);
    EXPECT_EQ(claimed(spool).tries, 1u);
    ASSERT_TRUE(spool.release(::getpid(), true, 2, "it crashed", 500));
    EXPECT_EQ(spool.state("bad"), JobState::Done);
    EXPECT_EQ(spool.outcome("bad")->error, "it crashed");
    EXPECT_EQ(spool.outcome("bad")->status, 500);
}

TEST_F(SpoolTest, AServerThatStartsGoesOnWithEverythingAccepted) {
    {
        Spool spool = open();
        for (const char* name : { "a", "b", "c" }) (void)accepted(spool, name);
        (void)claimed(spool);
        finish(spool, claimed(spool), "b");
        std::ofstream(mFolder / "new/half.0.json.x") << "{"; // was being written
    }
    Spool spool = open();
    ASSERT_TRUE(spool.releaseAll());
    EXPECT_EQ(spool.state("a"), JobState::Queued);
    EXPECT_EQ(spool.state("b"), JobState::Done);
    EXPECT_EQ(spool.state("c"), JobState::Queued);
    EXPECT_EQ(claimed(spool).tries, 0u) << "the server ended, not the job";
    EXPECT_TRUE(fs::is_empty(mFolder / "new"));
}

TEST_F(SpoolTest, AnOutcomeWithoutItsFileInRunningStays) {
    Spool spool = open();
    (void)accepted(spool, "a");
    const ClaimedJob job = claimed(spool);
    finish(spool, job, "a");
    std::ofstream(job.file) << "{}"; // the process ended between the outcome and removing this
    ASSERT_TRUE(spool.releaseAll());
    EXPECT_EQ(spool.state("a"), JobState::Done);
    EXPECT_EQ(spool.queuedCount(), 0u);
}

TEST_F(SpoolTest, OldOutcomesAreForgotten) {
    Spool spool = open();
    for (int i = 0; i < 5; ++i) {
        (void)accepted(spool, std::string(1, static_cast<char>('a' + i)));
        finish(spool, claimed(spool), "x");
        fs::last_write_time(mFolder / "done" / (std::string(1, static_cast<char>('a' + i)) + ".json"),
                            fs::file_time_type::clock::now() + std::chrono::seconds(i));
    }
    spool.keepNewest(2);
    EXPECT_EQ(spool.state("c"), JobState::Unknown);
    EXPECT_EQ(spool.state("d"), JobState::Done);
    EXPECT_EQ(std::distance(fs::directory_iterator(mFolder / "done"), {}), 4);
}

TEST_F(SpoolTest, AFolderThatCannotBeWrittenIsAnError) {
    std::ofstream(mFolder / "file") << "x";
    const Result<Spool> spool = Spool::open(mFolder / "file", 1);
    ASSERT_FALSE(spool);
    EXPECT_NE(spool.error().message.find("file"), std::string::npos);
}

TEST_F(SpoolTest, AWatchEndsWhenAFileComes) {
    Spool spool = open();
    FolderWatch watch(spool.queuedFolder());
    std::thread later([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        (void)accepted(spool, "a");
    });
    const auto begin = std::chrono::steady_clock::now();
    watch.wait(std::chrono::seconds(20));
    later.join();
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
}

} // namespace
} // namespace filament_core::server
