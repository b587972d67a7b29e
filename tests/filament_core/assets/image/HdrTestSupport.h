// SPDX-License-Identifier: Apache-2.0
/// Shared by the tests of images and environments: a temporary folder, images generated from a function.
#pragma once

#include "filament_core/assets/environment/IblDirections.h"
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/image/HdrImage.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <string>

#include <unistd.h>

namespace filament_core::assets {

class TemporaryFolder {
public:
    TemporaryFolder() {
        const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
        mPath = std::filesystem::temp_directory_path() /
                (std::string(test->test_suite_name()) + "." + test->name() + "." + std::to_string(::getpid()));
        std::filesystem::create_directories(mPath);
    }
    ~TemporaryFolder() {
        std::error_code error;
        std::filesystem::permissions(mPath, std::filesystem::perms::owner_all, error);
        std::filesystem::remove_all(mPath, error);
    }
    std::filesystem::path operator/(std::string const& name) const { return mPath / name; }
    std::filesystem::path const& path() const { return mPath; }

private:
    std::filesystem::path mPath;
};

/// An equirectangular image of radiance(direction), `samples` x `samples` points a pixel.
template <class F>
HdrImage pictureOf(uint32_t height, F&& radiance, uint32_t samples = 1) {
    HdrImage image{ .width = 2 * height, .height = height, .pixels = {}, .repairs = {} };
    for (uint32_t y = 0; y < image.height; ++y) {
        for (uint32_t x = 0; x < image.width; ++x) {
            float3 sum(0.0f);
            for (uint32_t i = 0; i < samples * samples; ++i) {
                const float u = (float(x) + (float(i % samples) + 0.5f) / float(samples)) / float(image.width);
                const float v = (float(y) + (float(i / samples) + 0.5f) / float(samples)) / float(image.height);
                sum += float3(radiance(directionFromEquirect({ u, v })));
            }
            image.pixels.push_back(sum / float(samples * samples));
        }
    }
    return image;
}

/// Replaces up to `changes` random bytes, and one time in four also truncates. The same for the same seed.
inline std::vector<std::byte> damaged(std::vector<std::byte> bytes, uint32_t seed, uint32_t changes = 8) {
    std::mt19937 random(seed);
    for (uint64_t i = 0, count = 1 + random() % changes; i < count; ++i) {
        bytes[random() % bytes.size()] = static_cast<std::byte>(random());
    }
    if (random() % 4 == 0) bytes.resize(random() % bytes.size());
    return bytes;
}

} // namespace filament_core::assets
