// SPDX-License-Identifier: Apache-2.0
#include <filament_core/Sky.h>

#include "base/OutOfMemory.h"
#include "filament_core/assets/environment/PhysicalSky.h"
#include "filament_core/engine/EnvironmentImpl.h"

#include <utility>

namespace filament_core {

using engine::PublicCall;

Result<Environment> loadSky(Engine& engine, SkyDesc const& sky, EnvironmentLoadOptions const& options) {
    const PublicCall call(engine, "loadSky(Engine, SkyDesc)");
    return orOutOfMemory("sky", {}, [&]() -> Result<Environment> {
        Engine::Impl& impl = engine.impl();
        auto data = assets::bakePhysicalSky(sky, impl.jobs, engine::environmentOptions(impl, options));
        if (!data) return data.error();
        Environment environment = engine::uploadEnvironment(engine, std::move(*data), "sky");
        impl.flush(); // the driver thread uploads while the caller continues
        return environment;
    });
}

Result<Fog> skyFog(Engine& engine, SkyDesc const& sky) {
    const PublicCall call(engine, "skyFog(Engine, SkyDesc)");
    return orOutOfMemory("sky", {}, [&]() -> Result<Fog> { return assets::physicalFog(sky, engine.impl().jobs); });
}

} // namespace filament_core
