# SPDX-License-Identifier: Apache-2.0
"""filament_core: renders glTF models and scenes to NumPy arrays, with the same bits on Vulkan and OpenGL ES.

    import filament_core as fc

    with fc.Engine("gles") as engine:
        scene = fc.Scene(engine)
        scene.add(engine.load_model("car.glb"), fit=True)
        scene.set_environment(engine.load_environment("sky.hdr"))
        view = fc.View((640, 360))
        view.look_at((0.9, 0.6, 1.5), (0, 0, 0))
        view["ao"] = "gtao"
        picture = fc.Renderer(engine).render(scene, view)      # uint8, (360, 640, 4)

docs/python.md is the manual; filament_core.reports reads what filament-conformance and filament-accuracy write.
"""
from . import reports
from ._core import (ClosedError, Comparison, CorruptError, DeviceError, Engine, Environment, Error, Identified, InvalidArgumentError,
                    Light, LightImage, Material, MaterialInstance, Mesh, Model, ModelCopy, NotFoundError, OutOfMemoryError,
                    ReflectionProbe, Renderer, Scene, SceneFile, Shape, Texture, ThreadError, UnreadableError, UnsupportedError, View, __version__, compare,
                    compile_material, compile_material_text, difference, explain_pixel, flip, list_devices, load_picture, options,
                    render_aovs, render_shares, save_picture)

__all__ = ["ClosedError", "Comparison", "CorruptError", "DeviceError", "Engine", "Environment", "Error", "Identified",
           "InvalidArgumentError", "Light", "LightImage", "Material", "MaterialInstance", "Mesh", "Model", "ModelCopy", "NotFoundError",
           "OutOfMemoryError", "ReflectionProbe", "Renderer", "Scene", "SceneFile", "Shape", "Texture", "ThreadError", "UnreadableError",
           "UnsupportedError", "View", "__version__", "compare", "compile_material", "compile_material_text", "difference",
           "explain_pixel", "flip", "list_devices", "load_picture", "options", "render_aovs", "render_shares", "reports", "save_picture"]

for _name in __all__:  # where users import them from: in messages, help() and pickles of exceptions
    if isinstance(globals()[_name], type):
        globals()[_name].__module__ = __name__
del _name
