// SPDX-License-Identifier: Apache-2.0
#include "jobsystem/JobFault.h"

#include <cstdio>
#include <cstdlib>
#include <exception>

namespace filament_core::jobs {

void reportThrow(const char* jobName, std::exception const& thrown) {
    std::fprintf(stderr, "job \"%s\" threw \"%s\": a job handles its exceptions itself\n", jobName, thrown.what());
    std::fflush(stderr);
    std::abort();
}

void reportThrow(const char* jobName) {
    try {
        throw;
    } catch (std::exception const& exception) {
        reportThrow(jobName, exception);
    } catch (...) {
        std::fprintf(stderr, "job \"%s\" threw what is no std::exception: a job handles its exceptions itself\n",
                     jobName);
    }
    std::fflush(stderr);
    std::abort();
}

} // namespace filament_core::jobs
