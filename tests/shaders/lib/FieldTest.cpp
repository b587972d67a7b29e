// SPDX-License-Identifier: Apache-2.0
// Fields of light over boxes: places and values.
#include "shaders/lib/LibCpp.h"

#include <gtest/gtest.h>

namespace filament_core::shader {
namespace {

TEST(Field, APlaceIsOneOnTheFacesAndNoMoreOutside) {
    const glm::vec3 inverse(2, 1, 0.5f); // a box of 1 x 2 x 4 metres
    EXPECT_EQ(lib::fieldPlace({ 0.25f, -1, 2 }, inverse), glm::vec3(0.5f, -1, 1));
    EXPECT_EQ(lib::fieldPlace({ 9, -9, 1 }, inverse), glm::vec3(1, -1, 0.5f));
}

TEST(Field, AValueChangesLinearlyAlongEachAxis) {
    const glm::vec4 value(1, -2, 4, 10);
    EXPECT_EQ(lib::fieldValue(value, glm::vec3(0)), 10);
    EXPECT_EQ(lib::fieldValue(value, { 1, 1, 1 }), 13);
    EXPECT_EQ(lib::fieldValue(value, { -1, 0, 0.5f }), 11);
}

} // namespace
} // namespace filament_core::shader
