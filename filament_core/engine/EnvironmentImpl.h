// SPDX-License-Identifier: Apache-2.0
/// Environment::Impl: the engine's objects of an environment, and their creation from its data.
///   Thread  app.
///   Fails   std::bad_alloc, which callers turn into an error.
#pragma once

#include "filament_core/assets/environment/Environment.h"
#include "filament_core/engine/EngineImpl.h"

#include <filament_core/Environment.h>

#include <cstddef>
#include <memory>
#include <string>

namespace filament_core {

struct Environment::Impl {
    Engine::Impl& engine; ///< while the link is alive
    engine::EngineLink link;
    Texture specular{}, sky{};
    Texture irradiance{}; ///< none: only coefficients are known
    IndirectLight indirectLight{};
    Skybox skybox{};
    EnvironmentLights lights{};

    ~Impl();
};

namespace engine {

/// Creates the objects of an environment, a texture a step. They travel with the next flush.
class EnvironmentUpload {
public:
    static constexpr size_t kSteps = 3;

    EnvironmentUpload(Engine::Impl& engine, assets::EnvironmentData data, std::string name);
    /// Returns the bytes that it copied.
    size_t step(size_t index);
    /// After all steps.
    Environment finish();

private:
    Engine::Impl& mEngine;
    assets::EnvironmentData mData;
    std::string mName;
    std::unique_ptr<Environment::Impl> mParts;
};

assets::EnvironmentOptions environmentOptions(Engine::Impl const& engine, EnvironmentLoadOptions const& options);

/// All steps at once.
Environment uploadEnvironment(Engine& engine, assets::EnvironmentData data, std::string name);

} // namespace engine
} // namespace filament_core
