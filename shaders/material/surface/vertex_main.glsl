// SPDX-License-Identifier: Apache-2.0
// Vertex stage of surface materials, entry points: attributes -> materialVertex() -> varyings, or the previous
// frame.

#if defined(WIDE_LINES)
const float kMaxLineWidth = 1024.0; // pixels

float inFrontOfNearPlane(vec4 clip) { return frameUniforms.exposure.w > 0.0 ? clip.z : clip.w - clip.z; }

// A corner behind the camera would turn the rectangle inside out: such an end moves to the near plane.
vec4 inFront(vec4 clip, vec4 end) {
    float here = inFrontOfNearPlane(clip), there = inFrontOfNearPlane(end);
    return here < 0.0 && there > 0.0 ? mix(clip, end, here / (here - there)) : clip;
}

// Moves one end of a segment sideways by half the width: a rectangle with the ends cut off squarely, as the
// rectangular lines of Vulkan's VK_EXT_line_rasterization. In homogeneous coordinates the direction is the same
// wherever the other end is, and the width is the same all along.
vec4 widened(vec4 clip, vec4 end, float side, float width) {
    vec2 pixels = passUniforms.target.xy;
    vec2 along = ((end.xy - clip.xy) * clip.w - clip.xy * (end.w - clip.w)) * pixels;
    float largest = max(abs(along.x), abs(along.y));
    vec3 direction = normalizeOrZero(largest > 0.0 ? vec3(along / largest, 0.0) : vec3(0.0));
    float halfWidth = width > 0.0 ? min(width, kMaxLineWidth) : 0.0; // NaN: nothing
    clip.xy += vec2(-direction.y, direction.x) * (side * halfWidth * clip.w) / pixels; // the screen is 2 wide
    return clip;
}
#endif

#if defined(SIZED_POINTS)
const float kMaxPointPixels = 1024.0, kMaxPointMeters = 1e6;

// From the centre of a point to one of its corners. In metres, the lens scales what is parallel to the image.
vec4 spreadPoint(vec4 clip, float pixels, float meters) {
    float onScreen = pixels > 0.0 ? min(pixels, kMaxPointPixels) : 0.0; // NaN: nothing
    float inWorld = meters > 0.0 ? min(meters, kMaxPointMeters) : 0.0;
    vec2 lens = abs(vec2(frameUniforms.clipFromView[0].x, frameUniforms.clipFromView[1].y));
    vec2 halfSide = max(onScreen * clip.w / passUniforms.target.xy, 0.5 * inWorld * lens); // the screen is 2 wide
    clip.xy += getPointCorner() * halfSide;
    return clip;
}
#endif

#if defined(NEEDS_NORMAL)
vec3 vertexTangent; // in object space, deformed
float vertexFrameSign = 1.0; // -1 if bones mirror
#endif

MaterialVertexInputs materialVertexInputs() {
    MaterialVertexInputs inputs;
    MATERIAL_CLEAR_VARIABLES(inputs)
#if defined(VARIANT_SKINNING)
    deformPosition(mesh_position);
#endif
#if defined(HAS_COLOR)
    inputs.color = mesh_color;
#endif
#if defined(HAS_UV0)
    inputs.uv0 = meshUv(mesh_uv0);
#endif
#if defined(HAS_UV1)
    inputs.uv1 = meshUv(mesh_uv1);
#endif
#if defined(NEEDS_NORMAL)
    vec3 normal, bitangent;
    tangentFrame(mesh_tangents, normal, vertexTangent, bitangent);
#if defined(VARIANT_SKINNING)
    vertexFrameSign = deformFrame(normal, vertexTangent);
#endif
    inputs.worldNormal = normalizeOrZero(normalToWorld(normal));
#endif
#if defined(HAS_CLIP_SPACE_TRANSFORM)
    inputs.clipSpaceTransform = mat4(1.0);
#endif
    inputs.worldPosition = worldPositionOfVertex();
#if defined(WIDE_LINES)
    inputs.lineWidth = 1.0;
    inputs.lineEnd = worldPositionOf(vec4(mesh_custom0.xyz, 1.0));
#endif
#if defined(SIZED_POINTS)
    inputs.pointPixels = 1.0;
    inputs.pointMeters = 0.0;
#endif

#if defined(HAS_CLIP_SPACE_POSITION) && defined(VERTEX_DOMAIN_DEVICE)
    inputs.clipSpacePosition = getPosition();
#elif defined(HAS_CLIP_SPACE_POSITION)
    inputs.clipSpacePosition = getClipFromWorldMatrix() * vec4(inputs.worldPosition.xyz, 1.0);
#endif
#if defined(HAS_MATERIAL_VERTEX)
    materialVertex(inputs);
#endif
    return inputs;
}

vec4 clipPosition(MaterialVertexInputs inputs, mat4 clipFromWorld) {
#if defined(HAS_CLIP_SPACE_POSITION)
    vec4 clip = inputs.clipSpacePosition;
#elif defined(HAS_CLIP_SPACE_TRANSFORM)
    vec4 clip = inputs.clipSpaceTransform * getPosition();
#elif defined(VERTEX_DOMAIN_DEVICE)
    vec4 clip = getPosition();
#else
    vec4 clip = clipFromWorld * vec4(inputs.worldPosition.xyz, 1.0);
#endif
#if defined(VERTEX_DOMAIN_DEVICE) && defined(VERTEX_DOMAIN_DEVICE_JITTERED)
    clip.xy += frameUniforms.jitter.xy * clip.w; // as clipFromWorld does elsewhere
#endif
#if defined(WIDE_LINES)
    vec4 lineEnd = clipFromWorld * vec4(inputs.lineEnd.xyz, 1.0);
    clip = widened(inFront(clip, lineEnd), lineEnd, mesh_custom0.w, inputs.lineWidth);
#endif
#if defined(SIZED_POINTS)
    clip = spreadPoint(clip, inputs.pointPixels, inputs.pointMeters);
#endif
    return clip;
}

#if defined(VARIANT_MOTION)

layout(location = 0) out vec4 vertex_lastClip;
layout(location = 1) out vec2 vertex_distances; // linear depth: in the previous frame, and now

float alongView(vec3 p) {
    mat4 view = frameUniforms.viewFromWorld;
    return -dot(vec3(view[0].z, view[1].z, view[2].z), p);
}

void main() {
    MaterialVertexInputs inputs = materialVertexInputs();
    gl_Position = clipPosition(inputs, frameUniforms.clipFromWorld);
    gl_PointSize = 1.0;
#if defined(VERTEX_DOMAIN_VIEW) || defined(VERTEX_DOMAIN_DEVICE)
    vertex_lastClip = gl_Position; // it goes with the camera, but not with the jitter
    vertex_lastClip.xy -= frameUniforms.jitter.xy * gl_Position.w;
    vertex_distances = vec2(1.0);
#else
    isLastFrame = true;
    MaterialVertexInputs last = materialVertexInputs();
    vertex_lastClip = clipPosition(last, passUniforms.lastClipFromWorld);
    vertex_distances = vec2(dot(passUniforms.lastAlongView, vec4(last.worldPosition.xyz, 1.0)),
            alongView(inputs.worldPosition.xyz));
#endif
}

#else

#if !defined(POSITION_ALONE)
void writeVaryings(MaterialVertexInputs inputs) {
#if defined(NEEDS_WORLD_POSITION)
    vertex_worldPosition = inputs.worldPosition.xyz;
#endif
#if defined(NEEDS_NORMAL)
    vertex_worldNormal = inputs.worldNormal;
#endif
#if defined(NEEDS_TANGENT)
    vertex_worldTangent = vec4(normalizeOrZero(directionToWorld(vertexTangent)),
            mesh_tangents.w < 0.0 ? -bitangentSign() : bitangentSign());
#if defined(VARIANT_SKINNING)
    vertex_worldTangent.w *= vertexFrameSign;
#endif
#endif
#if defined(HAS_COLOR)
    vertex_color = inputs.color;
#endif
#if defined(HAS_UV0) && defined(HAS_UV1)
    vertex_uv01 = vec4(inputs.uv0, inputs.uv1);
#elif defined(HAS_UV0)
    vertex_uv01 = vec4(inputs.uv0, 0.0, 0.0);
#elif defined(HAS_UV1)
    vertex_uv01 = vec4(0.0, 0.0, inputs.uv1);
#endif
#if defined(NEEDS_INSTANCE_INDEX)
    vertex_instanceIndex = getInstanceIndex();
#endif
    MATERIAL_WRITE_VARIABLES(inputs)
    MATERIAL_WRITE_CUSTOMS
}
#endif

void main() {
    MaterialVertexInputs inputs = materialVertexInputs();
#if !defined(POSITION_ALONE)
    writeVaryings(inputs);
#endif
    gl_Position = clipPosition(inputs, frameUniforms.clipFromWorld);
    gl_PointSize = 1.0; // both APIs leave the size of points undefined otherwise
}

#endif
