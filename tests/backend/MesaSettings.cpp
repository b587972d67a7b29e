// SPDX-License-Identifier: Apache-2.0
// The settings that every process gets which makes its drivers with backend/create, for tests that make them one room
// below: without them, Mesa crashes at vector widths that it does not support.
#include "backend/create/MesaEnvironment.h"

#include <gtest/gtest.h>

namespace filament_core::backend {
namespace {

class MesaSettings final : public testing::Environment {
    void SetUp() override { applyMesaEnvironment(); }
};

[[maybe_unused]] testing::Environment* const kMesaSettings = testing::AddGlobalTestEnvironment(new MesaSettings);

} // namespace
} // namespace filament_core::backend
