// SPDX-License-Identifier: Apache-2.0
// A job that throws or breaks a rule ends the process, and the message names the job.
#include "tests/jobsystem/JobSystemFixture.h"

#include <stdexcept>

namespace filament_core::jobs {
namespace {

class JobFaultDeathTest : public testing::TestWithParam<int> {
protected:
    void SetUp() override { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
};
INSTANTIATE_TEST_SUITE_P(Workers, JobFaultDeathTest, testing::Values(0, 2), workersName);

template <class F>
void runNamed(int workers, F&& function) {
    JobSystem jobs({ .workers = workers });
    JobGroup group(jobs);
    group.run<"skin">(function);
    group.wait();
}

TEST_P(JobFaultDeathTest, AnExceptionNamesTheJobAndSaysWhatWasThrown) {
    EXPECT_DEATH(runNamed(GetParam(), [] { throw std::runtime_error("no bones"); }), "job \"skin\" threw \"no bones\"");
}

TEST_P(JobFaultDeathTest, AnExceptionOfAnyTypeNamesTheJob) {
    EXPECT_DEATH(runNamed(GetParam(), [] { throw 7; }), "job \"skin\" threw what is no std::exception");
}

TEST_P(JobFaultDeathTest, ABrokenRuleNamesTheJobAndTheRule) {
    EXPECT_DEATH(runNamed(GetParam(), [] { FILAMENT_ASSERT(1 + 1 == 3, "bones are sorted"); }),
                 "bones are sorted .1 . 1 == 3, .*JobFaultTest.cpp:[0-9]+. in job \"skin\"");
}

TEST_P(JobFaultDeathTest, TheInnermostJobIsNamed) {
    EXPECT_DEATH(
            {
                JobSystem jobs({ .workers = GetParam() });
                JobGroup group(jobs);
                group.run<"outer">([&] {
                    parallelFor<"inner">(
                            jobs, 8, 1, [](size_t begin, size_t) { FILAMENT_ASSERT(begin != 5, "five is right out"); });
                });
                group.wait();
            },
            "five is right out.* in job \"inner\"");
}

TEST_P(JobFaultDeathTest, AfterAJobItsNameIsForgotten) {
    EXPECT_DEATH(
            {
                runNamed(GetParam(), [] {});
                std::fprintf(stderr, "context: %s\n", tAssertContext ? tAssertContext : "none");
                std::abort();
            },
            "context: none");
}

TEST_P(JobFaultDeathTest, AnExceptionInABackgroundJobNamesIt) {
    EXPECT_DEATH(
            {
                JobSystem jobs({ .workers = GetParam() });
                jobs.runBackground<"decode">([] { throw std::runtime_error("truncated file"); });
            },
            "job \"decode\" threw \"truncated file\"");
}

TEST_P(JobFaultDeathTest, AnExceptionInAContinuationNamesIt) {
    EXPECT_DEATH(
            {
                JobSystem jobs({ .workers = GetParam() });
                JobGroup group(jobs);
                JobGroup next(jobs);
                group.run<"load">([] {});
                group.then<"upload">(next, [] { throw std::runtime_error("no memory"); });
                next.wait();
            },
            "job \"upload\" threw \"no memory\"");
}

TEST_P(JobFaultDeathTest, AnExceptionInASuccessorNamesIt) {
    EXPECT_DEATH(runNamed(GetParam(), [] { return next<"cloth">([] { throw std::runtime_error("torn"); }); }),
                 "job \"cloth\" threw \"torn\"");
}

} // namespace
} // namespace filament_core::jobs
