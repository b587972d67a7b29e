// SPDX-License-Identifier: Apache-2.0
// jobs [WORKERS]: the job system alone, without graphics. Rows of a fractal are computed by all cores, letters are
// counted when the rows are done, and a background job writes its line meanwhile. The result does not depend on the
// number of workers.
#include <jobsystem/JobSystem.h>

#include <algorithm>
#include <array>
#include <complex>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

using namespace filament_core::jobs;

namespace {

constexpr size_t kColumns = 64, kRows = 24;

/// How long z -> z^2 + c stays small, as a letter.
char letterAt(size_t column, size_t row) {
    const std::complex<double> c(-2.1 + 2.9 * static_cast<double>(column) / kColumns,
                                 -1.2 + 2.4 * static_cast<double>(row) / (kRows - 1));
    std::complex<double> z = 0;
    int steps = 0;
    while (steps < 2000 && std::norm(z) < 4) z = z * z + c, ++steps;
    return steps == 2000 ? '#' : ".:-=+*%"[std::min(steps / 3, 6)];
}

} // namespace

int main(int argc, char** argv) {
    JobSystem jobs({ .workers = argc > 1 ? std::atoi(argv[1]) : -1 });
    AdoptedThread seat(jobs); // this thread works, too

    std::vector<std::string> rows(kRows, std::string(kColumns, ' '));
    std::string note;
    JobGroup background(jobs, Priority::Background);
    background.runBackground<"note">([&] { note = "a background job may wait for files and locks"; });

    // Fork: one job for each range of two rows. The ranges do not depend on the workers.
    parallelFor<"rows">(jobs, kRows, 2, [&](size_t begin, size_t end) {
        for (size_t row = begin; row < end; ++row) {
            for (size_t column = 0; column < kColumns; ++column) rows[row][column] = letterAt(column, row);
        }
    });

    // Two groups: the jobs of the first count, and the second continues where it ends.
    std::array<size_t, kRows> counts{};
    size_t sum = 0;
    JobGroup counting(jobs), adding(jobs);
    for (size_t row = 0; row < kRows; ++row)
        counting.run<"count">([&, row] { counts[row] = static_cast<size_t>(std::ranges::count(rows[row], '#')); });
    counting.then<"add">(adding, [&] {
        for (const size_t count : counts) sum += count;
    });
    adding.wait(); // join; meanwhile this thread runs jobs
    counting.wait();
    background.wait();

    for (std::string const& row : rows) std::printf("%s\n", row.c_str());
    std::printf("%zu of %zu points never leave; %s\n", sum, kColumns * kRows, note.c_str());
    return 0;
}
