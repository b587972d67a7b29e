// SPDX-License-Identifier: Apache-2.0
/// editable: a copy of the code of one variant's stage, for tests that change it. The variant gets the copy; others
/// that shared the stage keep it as it was.
#pragma once

#include "shaders/package/Package.h"

#include <memory>
#include <utility>

namespace filament_core::shader::test {

inline StageCode& editable(SharedStage& stage) {
    auto copy = std::make_shared<StageCode>(*stage);
    StageCode& code = *copy;
    stage = std::move(copy);
    return code;
}

} // namespace filament_core::shader::test
