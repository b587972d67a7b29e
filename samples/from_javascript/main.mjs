// SPDX-License-Identifier: Apache-2.0
// node main.mjs HEADER LIBRARY MODEL [vulkan|gles] [OUT.png]: the program of ../from_c in JavaScript.
//   HEADER    filament_core.h      LIBRARY   libfilament_core_c.so
import { load } from "./filament_core.mjs";

const [header, library, file, api = "gles", out = "from_javascript.png"] = process.argv.slice(2);
if (!file) throw new Error("usage: node main.mjs HEADER LIBRARY MODEL [vulkan|gles] [OUT.png]");
const fc = load(header, library);

const options = { ...fc.engineOptionsInit(), backend: api === "vulkan" ? fc.FC_BACKEND_VULKAN : fc.FC_BACKEND_GLES };
const engine = fc.engineCreate(options);
const model = fc.modelLoad(engine, file);
const sky = fc.environmentSky(engine, 3, { x: 0.5, y: 0.5, z: 0.7 });
const scene = fc.sceneCreate(engine);
const identity = { m: [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1] };
fc.sceneAddModel(scene, model, identity);
fc.sceneSetEnvironment(scene, sky, 1000, 0);

const { min, max } = fc.sceneBounds(scene);
const center = { x: (min.x + max.x) / 2, y: (min.y + max.y) / 2, z: (min.z + max.z) / 2 };
const height = max.y - min.y;
const eye = { x: center.x + 0.6 * height, y: center.y - 0.2 * height, z: center.z + 1.5 * height };
const view = fc.viewCreate({ x: 320, y: 180 });
fc.viewSetOption(view, "ambientOcclusion", "on");
fc.viewLookAt(view, eye, center, { x: 0, y: 1, z: 0 }, { ...fc.cameraInit(), vertical_fov_degrees: 40 });

const renderer = fc.rendererCreate(engine);
const image = fc.rendererRenderToImage(renderer, scene, view);
fc.imageSavePng(image, out);
for (const [end, object] of [[fc.imageDestroy, image], [fc.rendererDestroy, renderer], [fc.viewDestroy, view],
                             [fc.sceneDestroy, scene], [fc.environmentDestroy, sky], [fc.modelDestroy, model],
                             [fc.engineDestroy, engine]])
    end(object);
