// SPDX-License-Identifier: Apache-2.0
// Adds up numbers on all cores: every header of the job system, and nothing else.
#include <jobsystem/JobSystem.h>
#include <jobsystem/JobTrace.h>

#include <filament_core/Version.h>

#include <atomic>
#include <cstdint>
#include <cstdio>
#include <sstream>

#ifdef GLM_SETUP_INCLUDED
#error "the headers of the job system include GLM"
#endif

int main() {
    using namespace filament_core::jobs;
    JobSystem jobs({ .workers = 2, .trace = true });
    std::atomic<uint64_t> sum{ 0 };
    JobGroup group(jobs), after(jobs);
    group.run<"sum">([&] {
        parallelFor<"part">(jobs, 100'000, 1000, [&](size_t begin, size_t end) {
            uint64_t part = 0;
            for (size_t i = begin; i < end; ++i) part += i;
            sum += part;
        });
    });
    uint64_t seen = 0;
    group.then<"read">(after, [&] { seen = sum; });
    after.wait();
    std::printf("jobs: filament_core %s, sum %llu\n", filament_core::versionText(),
                static_cast<unsigned long long>(seen));
    return seen == 100'000ull * 99'999 / 2 && jobs.trace() != nullptr ? 0 : 1;
}
