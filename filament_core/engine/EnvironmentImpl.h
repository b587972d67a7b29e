// SPDX-License-Identifier: Apache-2.0
/// Environment::Impl: the engine's objects of an environment, and how they are made of its data.
///   Thread  app.
///   Fails   std::bad_alloc, which callers turn into an error.
#pragma once

#include "filament_core/assets/environment/Environment.h"
#include "filament_core/engine/EngineImpl.h"

#include <filament/Environment.h>

#include <string>

namespace filament {

struct Environment::Impl {
    Engine::Impl& engine; ///< while the link is alive
    engine::EngineLink link;
    Texture specular{}, sky{};
    Texture irradiance{}; ///< none: only coefficients are known
    IndirectLight indirectLight{};
    Skybox skybox{};

    ~Impl();
};

namespace engine {

/// The textures travel with the next flush.
Environment uploadEnvironment(Engine& engine, assets::EnvironmentData const& data, std::string const& name);

} // namespace engine
} // namespace filament
