// SPDX-License-Identifier: Apache-2.0
#include "jobsystem/CpuQuota.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::jobs {
namespace {

namespace fs = std::filesystem;

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

// The process's group in version 1's cpu controller or in version 2's single hierarchy.
struct Membership {
    bool unified = false; // version 2
    std::string group;    // "/user.slice/render.service"
};

// Where a hierarchy is mounted: `point` shows the group `group` and its descendants.
struct Mount {
    bool unified = false;
    std::string group;
    std::string point;
};

bool hasToken(std::string_view list, std::string_view token) {
    for (size_t begin = 0; begin <= list.size();) {
        const size_t end = std::min(list.find(',', begin), list.size());
        if (list.substr(begin, end - begin) == token) return true;
        begin = end + 1;
    }
    return false;
}

// Lines "hierarchy:controllers:group"; the group may contain colons. Version 2 is "0::group".
std::vector<Membership> readMemberships(fs::path const& file) {
    std::vector<Membership> memberships;
    std::ifstream lines(file);
    for (std::string line; std::getline(lines, line);) {
        const size_t first = line.find(':');
        const size_t second = first == std::string::npos ? first : line.find(':', first + 1);
        if (second == std::string::npos) continue;
        const std::string_view controllers = std::string_view(line).substr(first + 1, second - first - 1);
        const bool unified = line.starts_with("0::");
        if (unified || hasToken(controllers, "cpu")) memberships.push_back({ unified, line.substr(second + 1) });
    }
    return memberships;
}

// In mountinfo, blanks, tabs, newlines and backslashes of a path are written as a backslash and three octal digits.
std::string unescaped(std::string_view text) {
    const auto isOctal = [](char c) { return c >= '0' && c <= '7'; };
    std::string plain;
    for (size_t i = 0; i < text.size(); ++i) {
        const std::string_view digits = text.substr(i + 1, 3);
        if (text[i] == '\\' && digits.size() == 3 && std::all_of(digits.begin(), digits.end(), isOctal)) {
            plain += static_cast<char>((digits[0] - '0') * 64 + (digits[1] - '0') * 8 + (digits[2] - '0'));
            i += 3;
        } else {
            plain += text[i];
        }
    }
    return plain;
}

// Lines "id parent device root point options [tags] - type source superoptions".
std::vector<Mount> readMounts(fs::path const& file) {
    std::vector<Mount> mounts;
    std::ifstream lines(file);
    for (std::string line; std::getline(lines, line);) {
        const size_t dash = line.find(" - ");
        if (dash == std::string::npos) continue;
        std::string id, parent, device, group, point, type, source, superOptions;
        std::istringstream(line.substr(0, dash)) >> id >> parent >> device >> group >> point;
        std::istringstream(line.substr(dash + 3)) >> type >> source >> superOptions;
        const bool unified = type == "cgroup2";
        if (point.empty() || !(unified || (type == "cgroup" && hasToken(superOptions, "cpu")))) continue;
        mounts.push_back({ unified, unescaped(group), unescaped(point) });
    }
    return mounts;
}

// The path from the mount point down to the group. A container may mount only part of the hierarchy, or the group may
// lie outside it ("/../x"); then the mount point itself is the closest that this process can see.
fs::path pathBelow(Mount const& mount, std::string_view group) {
    if (group.find("/..") != std::string_view::npos) return {};
    if (mount.group == "/") return fs::path(group).relative_path();
    if (!group.starts_with(mount.group)) return {};
    const std::string_view rest = group.substr(mount.group.size());
    return rest.starts_with('/') ? fs::path(rest).relative_path() : fs::path();
}

double processors(double quota, double period) { return quota > 0 && period > 0 ? quota / period : kUnlimited; }

double quotaOfGroup(fs::path const& directory, bool unified) {
    double quota = 0, period = 0; // unreadable values stay 0; "max" and -1 mean no limit
    if (unified) {
        std::ifstream(directory / "cpu.max") >> quota >> period;
    } else {
        std::ifstream(directory / "cpu.cfs_quota_us") >> quota;
        std::ifstream(directory / "cpu.cfs_period_us") >> period;
    }
    return processors(quota, period);
}

// The smallest quota of a group and its ancestors.
double quotaOfChain(fs::path const& mountPoint, fs::path group, bool unified) {
    double quota = quotaOfGroup(mountPoint, unified);
    for (; !group.empty(); group = group.parent_path())
        quota = std::min(quota, quotaOfGroup(mountPoint / group, unified));
    return quota;
}

} // namespace

double cpuQuota(fs::path const& root) {
    double quota = kUnlimited;
    const std::vector<Mount> mounts = readMounts(root / "proc/self/mountinfo");
    for (Membership const& membership : readMemberships(root / "proc/self/cgroup")) {
        for (Mount const& mount : mounts) {
            if (mount.unified != membership.unified) continue;
            const fs::path point = root / fs::path(mount.point).relative_path();
            quota = std::min(quota, quotaOfChain(point, pathBelow(mount, membership.group), mount.unified));
        }
    }
    return quota;
}

} // namespace filament_core::jobs
