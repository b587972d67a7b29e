// SPDX-License-Identifier: Apache-2.0
#include "tools/view/document/Document.h"

namespace filament_core::view {

Document makeDocument(tools::SceneOptions const& options, std::filesystem::path const& model,
                      std::filesystem::path const& environment) {
    Document document;
    document.model = { .file = model, .options = options.modelOptions, .fit = options.fit, .variant = options.variant };
    document.environment = { .file = environment,
                             .prefersModels = options.environment.empty(),
                             .options = options.environmentOptions,
                             .settings = { .illuminance = options.iblIntensity, .skybox = options.skybox } };
    document.view = options.view;
    document.view.camera = tools::cameraOf(options);
    document.view.display.look = nullptr;
    document.look = options.lookFile;
    document.dirt = options.dirt;
    if (options.sun) document.lights.push_back({ .name = "sun", .light = *options.sun });
    return document;
}

} // namespace filament_core::view
