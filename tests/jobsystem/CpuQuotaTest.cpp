// SPDX-License-Identifier: Apache-2.0
// Directories with the files of /proc and of the cgroup mounts, as found on various machines.
#include "jobsystem/CpuQuota.h"

#include "tests/jobsystem/FakeRoot.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace filament_core::jobs {
namespace {

constexpr double kNoQuota = std::numeric_limits<double>::infinity();

// Version 2, as on a current distribution.
constexpr const char* kUnifiedMount =
        "31 23 0:26 / /sys/fs/cgroup rw,nosuid shared:9 - cgroup2 cgroup2 rw,nsdelegate\n";
// Version 1, cpu and cpuacct together.
constexpr const char* kLegacyMount =
        "33 31 0:30 / /sys/fs/cgroup/cpu,cpuacct rw,nosuid shared:11 - cgroup cgroup rw,cpu,cpuacct\n"
        "34 31 0:31 / /sys/fs/cgroup/cpuset rw,nosuid shared:12 - cgroup cgroup rw,cpuset\n";

/// The two files of a group in version 1.
void writeQuota(FakeRoot const& root, std::string const& group, const char* quota, const char* period) {
    root.write("sys/fs/cgroup/" + group + "/cpu.cfs_quota_us", quota);
    root.write("sys/fs/cgroup/" + group + "/cpu.cfs_period_us", period);
}

TEST(CpuQuota, IsUnlimitedWhereThereAreNoFilesAtAll) { EXPECT_EQ(cpuQuota(FakeRoot().path()), kNoQuota); }

TEST(CpuQuota, IsTheQuotientOfCpuMaxInVersion2) {
    const FakeRoot root;
    root.write("proc/self/mountinfo", kUnifiedMount);
    root.write("proc/self/cgroup", "0::/user.slice/render.service\n");
    root.write("sys/fs/cgroup/user.slice/render.service/cpu.max", "150000 100000\n");
    EXPECT_EQ(cpuQuota(root.path()), 1.5);
}

TEST(CpuQuota, IsTheLeastOfTheGroupAndThoseAboveIt) {
    const FakeRoot root;
    root.write("proc/self/mountinfo", kUnifiedMount);
    root.write("proc/self/cgroup", "0::/a/b/c\n");
    root.write("sys/fs/cgroup/a/b/c/cpu.max", "max 100000\n");
    root.write("sys/fs/cgroup/a/b/cpu.max", "800000 100000\n");
    root.write("sys/fs/cgroup/a/cpu.max", "300000 100000\n");
    root.write("sys/fs/cgroup/other/cpu.max", "100000 100000\n");
    EXPECT_EQ(cpuQuota(root.path()), 3.0);
    root.write("sys/fs/cgroup/cpu.max", "50000 100000\n"); // the root group of a container's own name space
    EXPECT_EQ(cpuQuota(root.path()), 0.5);
}

TEST(CpuQuota, IsTheQuotientOfTwoFilesInVersion1) {
    const FakeRoot root;
    root.write("proc/self/mountinfo", kLegacyMount);
    root.write("proc/self/cgroup", "5:cpuset:/\n4:cpu,cpuacct:/docker/abc\n1:name=systemd:/docker/abc\n");
    writeQuota(root, "cpu,cpuacct/docker/abc", "-1\n", "100000\n");
    EXPECT_EQ(cpuQuota(root.path()), kNoQuota);
    writeQuota(root, "cpu,cpuacct/docker/abc", "50000\n", "20000\n");
    EXPECT_EQ(cpuQuota(root.path()), 2.5);
}

TEST(CpuQuota, TakesTheLesserWhereBothVersionsAreMounted) {
    const FakeRoot root;
    root.write("proc/self/mountinfo",
               std::string(kLegacyMount) + "41 31 0:38 / /sys/fs/cgroup/unified rw - cgroup2 cgroup2 rw\n");
    root.write("proc/self/cgroup", "4:cpu,cpuacct:/x\n0::/y\n");
    writeQuota(root, "cpu,cpuacct/x", "400000", "100000");
    root.write("sys/fs/cgroup/unified/y/cpu.max", "700000 100000");
    root.write("sys/fs/cgroup/unified/x/cpu.max", "50000 100000"); // not the process's group in that hierarchy
    EXPECT_EQ(cpuQuota(root.path()), 4.0);
    root.write("sys/fs/cgroup/unified/y/cpu.max", "100000 100000");
    EXPECT_EQ(cpuQuota(root.path()), 1.0);
}

// A container of version 1 without its own name space: the mount shows only the container's part of the hierarchy.
TEST(CpuQuota, FindsTheGroupBelowAMountThatShowsAPartOfTheHierarchy) {
    const FakeRoot root;
    root.write("proc/self/mountinfo", "33 31 0:30 /docker/abc /sys/fs/cgroup/cpu ro - cgroup cgroup rw,cpu\n");
    root.write("proc/self/cgroup", "4:cpu:/docker/abc\n");
    writeQuota(root, "cpu", "200000", "100000");
    EXPECT_EQ(cpuQuota(root.path()), 2.0);
    root.write("proc/self/cgroup", "4:cpu:/docker/abc/nested\n");
    writeQuota(root, "cpu/nested", "100000", "100000");
    EXPECT_EQ(cpuQuota(root.path()), 1.0);
    // other containers, the first of which only looks similar: the mount point is as close as one can see
    for (const char* folder : { "def", "other" }) {
        writeQuota(root, std::string("cpu/") + folder, "50000", "100000");
    }
    for (const char* membership : { "4:cpu:/docker/abcdef\n", "4:cpu:/other\n" }) {
        root.write("proc/self/cgroup", membership);
        EXPECT_EQ(cpuQuota(root.path()), 2.0) << membership;
    }
}

TEST(CpuQuota, DoesNotLeaveTheMountForAGroupOutsideOfIt) {
    const FakeRoot root;
    root.write("proc/self/mountinfo", kUnifiedMount);
    root.write("proc/self/cgroup", "0::/../../elsewhere\n");
    root.write("sys/elsewhere/cpu.max", "100000 100000");
    root.write("sys/fs/cgroup/cpu.max", "600000 100000");
    EXPECT_EQ(cpuQuota(root.path()), 6.0);
}

TEST(CpuQuota, ReadsMountPointsWithBlanksAndGroupsWithColons) {
    const FakeRoot root;
    root.write("proc/self/mountinfo", "31 23 0:26 / /mnt/c\\040g\\134x rw - cgroup2 none rw\n");
    root.write("proc/self/cgroup", "0::/app:1\n");
    root.write("mnt/c g\\x/app:1/cpu.max", "100000 50000");
    EXPECT_EQ(cpuQuota(root.path()), 2.0);
}

TEST(CpuQuota, IgnoresWhatIsMalformed) {
    const FakeRoot root;
    root.write("proc/self/mountinfo", std::string("\n - \nx - cgroup2\n1 2 3 4\n\\04") + '\n' + kUnifiedMount + "9 9");
    root.write("proc/self/cgroup", "nonsense\n0:\n::::\n0::\n0::/g\n\xff\xfe");
    EXPECT_EQ(cpuQuota(root.path()), kNoQuota);
    for (const char* text :
         { "", "\n", "max", "x y", "-5 100000", "100000", "100000 0", "100000 -1", "1e999 1", "0 0" }) {
        root.write("sys/fs/cgroup/g/cpu.max", text);
        EXPECT_EQ(cpuQuota(root.path()), kNoQuota) << '"' << text << '"';
    }
    root.write("sys/fs/cgroup/g/cpu.max", "100000 100000");
    EXPECT_EQ(cpuQuota(root.path()), 1.0);
}

} // namespace
} // namespace filament_core::jobs
