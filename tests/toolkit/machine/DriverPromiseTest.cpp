// SPDX-License-Identifier: Apache-2.0
#include "toolkit/machine/DriverPromise.h"
#include "toolkit/machine/Machine.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace filament_core::tools {
namespace {

using testing::HasSubstr;

DeviceDescription lavapipe(std::string const& version) {
    return { .backend = Backend::Vulkan,
             .device = "llvmpipe (LLVM 15.0.6, 256 bits)",
             .driver = "Mesa " + version + " (LLVM 15.0.6), Vulkan 1.3.230" };
}
DeviceDescription llvmpipe(std::string const& version) {
    return { .backend = Backend::Gles,
             .device = "llvmpipe (LLVM 15.0.6, 256 bits)",
             .driver = "OpenGL ES 3.2 Mesa " + version };
}
std::string noteOf(std::vector<DeviceDescription> const& devices, std::string_view features = kPromisedFeatures) {
    return driverNote(devices, features);
}

TEST(DriverPromise, HoldsForOneMeasuredVersionOnBothApis) {
    for (const char* version : { "22.3.0", "22.3.6", "23.2.1-1ubuntu3", "25.0.7-2", "26.1.6", "26.1.0-rc2" }) {
        EXPECT_EQ(noteOf({ lavapipe(version), llvmpipe(version) }), "") << version;
        EXPECT_EQ(noteOf({ llvmpipe(version) }), "") << version;
    }
    EXPECT_EQ(noteOf({}), "");
}

TEST(DriverPromise, OfMixedVersionsSaysWhichAndWhatToUpgrade) {
    const std::string note = noteOf({ lavapipe("25.0.7"), llvmpipe("22.3.6") });
    EXPECT_THAT(note, HasSubstr("Mesa 25.0.7 and 22.3.6"));
    EXPECT_THAT(note, HasSubstr("upgrade mesa-vulkan-drivers and libgl1-mesa-dri together"));
    EXPECT_NE(noteOf({ lavapipe("25.0.7"), llvmpipe("25.0.6") }), "");
}

TEST(DriverPromise, OfVersionsThatNobodyMeasuredSaysSo) {
    EXPECT_THAT(noteOf({ lavapipe("20.3.5") }),
                HasSubstr("Mesa 20.3.5 is older than those that were measured, 22.3 to"));
    EXPECT_THAT(noteOf({ lavapipe("26.2.0") }), HasSubstr("Mesa 26.2.0 is newer"));
}

TEST(DriverPromise, OfOtherDriversNamesThem) {
    const DeviceDescription gpu{ .backend = Backend::Vulkan,
                                 .device = "NVIDIA T4",
                                 .driver = "NVIDIA 550.1, Vulkan 1.3" };
    EXPECT_THAT(noteOf({ llvmpipe("22.3.6"), gpu }), HasSubstr("NVIDIA T4 (NVIDIA 550.1, Vulkan 1.3) may round"));
    EXPECT_THAT(noteOf({ { .device = "llvmpipe", .driver = "Mesa without a number" } }), HasSubstr("may round"));
}

TEST(DriverPromise, OfAProcessorWithoutFmaIsThatOfBothApisOnly) {
    EXPECT_THAT(noteOf({ lavapipe("22.3.6"), llvmpipe("22.3.6") }, "avx no-fma"), HasSubstr("'avx no-fma'"));
}

TEST(MesaVersion, IsReadFromTheNamesOfBothApis) {
    EXPECT_EQ(mesaVersion(lavapipe("25.0.7-2").driver), "25.0.7");
    EXPECT_EQ(mesaVersion(llvmpipe("23.2.1-1ubuntu3.1~22.04.3").driver), "23.2.1");
    EXPECT_EQ(mesaVersion("NVIDIA 550.1, Vulkan 1.3"), "");
    EXPECT_EQ(mesaVersion("Mesa"), "");
}

// Makers, generations and wider vectors do not matter; features that change rounding do.
TEST(CpuFeatures, AreThoseThatMesaUses) {
    for (const char* override : { static_cast<const char*>(nullptr), "avx", "avx2", "avx512", "" })
        EXPECT_EQ(cpuFeatures(true, true, override), "avx fma");
    for (const char* override : { "sse4.1", "ssse3", "sse3", "sse2", "sse", "nosse" })
        EXPECT_EQ(cpuFeatures(true, true, override), "no-avx no-fma") << override;
    EXPECT_EQ(cpuFeatures(true, false, nullptr), "avx no-fma");
    EXPECT_EQ(cpuFeatures(false, false, nullptr), "no-avx no-fma");
}

} // namespace
} // namespace filament_core::tools
