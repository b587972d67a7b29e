// SPDX-License-Identifier: Apache-2.0
// Section planes (View::section), after the material's own code: what is cut off, and caps. section_api.glsl explains.

// Caps where rays leave what is left inside of a solid have draws of their own (passes/SlabCaps.h).
const float kFirstSurfaces = -1.0; // all that lies behind where rays enter what is left
const float kSlabCaps = -2.0;      // of those the back faces behind what is left: they show caps

bool isSectionPart(float part) { return ofFragment(passUniforms.raster.y) == part; }

bool section_isCut = false;         // nothing of the fragment is left
int section_samples = -1;           // those that are left
highp vec3 section_normal;          // of a cap, towards what is cut off
highp vec3 section_right, section_down; // from section_point to those of the neighbours

int sectionCount() { return int(ofFragment(frameUniforms.section.x)); }
bool isCorner() { return ofFragment(frameUniforms.section.y) > 0.0; }

const highp float kSectionSlack = 4e-6; // of the distance from the camera: more than positions are rounded by

const int kEntered = 1, kLeft = 2; // planes whose front rays enter, and leave; the sum: all

// Metres in front of what cuts; negative: cut off. A face in a plane is on the side that its solid is on: it is left
// where rays enter what is left, and cut off where they leave it.
highp float distanceToSection(int planes, highp vec3 point) {
    int count = sectionCount();
    bool corner = isCorner();
    highp float nearest = count > 0 && corner ? -1e30 : 1e30;
    highp float slack = kSectionSlack * (abs(point.x) + abs(point.y) + abs(point.z));
    for (int i = 0; i < count; ++i) {
        highp vec4 plane = frameUniforms.sectionPlanes[i];
        highp float here = dot(plane.xyz, point) + plane.w;
        bool isEntered = dot(plane.xyz, shading_view) < 0.0;
        here += isEntered ? slack : -slack;
        if ((planes & (isEntered ? kEntered : kLeft)) == 0) continue;
        nearest = corner ? max(nearest, here) : min(nearest, here);
    }
    return nearest;
}

// Those that cut what is drawn.
int cuttingPlanes() {
    if (isSectionPart(kFirstSurfaces)) return kEntered;
    return isSectionPart(kSlabCaps) ? kLeft : kEntered + kLeft;
}

#if !defined(DEPTH_RUNS_MATERIAL)

// Bit s: sample s is in front of the planes; all bits if a pixel has one. The samples of a pixel lie where Vulkan has
// them (1.3, "Multisampling", standard sample locations of four samples); the middle of the pixel is 0.
int samplesLeft(int planes, highp vec3 point) {
    if (ofFragment(passUniforms.raster.x) <= 1.0) return distanceToSection(planes, point) < 0.0 ? 0 : -1;
    highp vec2 places[4];
    places[0] = vec2(-0.125, -0.375);
    places[1] = vec2(0.375, -0.125);
    places[2] = vec2(-0.375, 0.125);
    places[3] = vec2(0.125, 0.375);
    int left = 0;
    for (int i = 0; i < 4; ++i) {
        highp vec3 place = point + section_right * places[i].x + section_down * places[i].y;
        if (distanceToSection(planes, place) >= 0.0) left |= 1 << i;
    }
    return left;
}

#endif

// The view ray towards the mesh's point: `back` metres before that point it enters what is left, through a plane.
struct SectionEntry {
    highp float back;
    highp vec3 normal; // of the plane
    bool exists;
};

// A ray that comes from behind a plane, or from infinity if it is parallel to the others.
SectionEntry sectionEntry(highp vec3 point, highp vec3 along, bool isParallel) {
    const highp float kNowhere = 1e30;
    SectionEntry entry = SectionEntry(kNowhere, vec3(0.0), false);
    bool corner = isCorner();
    highp float leaves = kNowhere; // of a corner: where the ray enters what is cut off
    int count = sectionCount();
    for (int i = 0; i < count; ++i) {
        highp vec4 plane = frameUniforms.sectionPlanes[i];
        highp float slope = dot(plane.xyz, along);
        highp float back = (dot(plane.xyz, point) + plane.w) / slope;
        bool beginsBehind = isParallel ? slope > 0.0 : plane.w < 0.0;
        if (beginsBehind && slope > 0.0) {
            // Of all planes the last that is crossed; out of a corner the first.
            bool isNext = !entry.exists || (corner ? back > entry.back : back < entry.back);
            if (isNext) entry = SectionEntry(back, plane.xyz, true);
        } else if (corner && !beginsBehind) {
            leaves = slope < 0.0 ? min(leaves, back) : -kNowhere;
        }
    }
    // The ray is in the corner between both, and that before the mesh's point.
    if (corner) entry.exists = entry.exists && leaves > entry.back && leaves + entry.back > 0.0;
    return entry;
}

// What lies before the near plane is not seen.
bool isBehindNearPlane(highp vec3 point) {
    highp vec4 clip = frameUniforms.clipFromWorld * vec4(point, 1.0);
    return (ofFragment(frameUniforms.exposure.w) > 0.0 ? clip.z : clip.w - clip.z) >= 0.0;
}

#if defined(DEPTH_RUNS_MATERIAL)

// Negative: the fragment is not drawn.
highp float sectionDistance(highp vec3 point) {
    highp float here = distanceToSection(cuttingPlanes(), point);
    if (!isSectionPart(kSlabCaps)) return here;
    if (gl_FrontFacing || here >= 0.0) return -1.0;
    SectionEntry entry = sectionEntry(point, -shading_view, ofFragment(frameUniforms.clipFromView[3].w) != 0.0);
    highp vec3 cap = point + shading_view * entry.back;
    return entry.exists && isBehindNearPlane(cap) ? distanceToSection(kLeft, cap) : -1.0;
}

#else

// From the derivatives of the mesh's point those of the point where the same rays meet the plane.
highp vec3 onPlane(highp vec3 difference, highp vec3 along, highp float nearer) {
    return (difference - along * (dot(section_normal, difference) / dot(section_normal, along))) * nearer;
}

void findCap() {
    highp vec3 point = pointOfMesh(), along = -shading_view;
    bool isParallel = ofFragment(frameUniforms.clipFromView[3].w) != 0.0;
    SectionEntry entry = sectionEntry(point, along, isParallel);
    highp vec3 cap = point - along * entry.back;
    if (!entry.exists || !isBehindNearPlane(cap)) return;
    section_isCap = true;
    section_point = cap;
    section_normal = -entry.normal;
    highp float nearer = isParallel ? 1.0 : dot(cap, along) / dot(point, along);
    section_right = onPlane(section_right, along, nearer);
    section_down = onPlane(section_down, along, nearer);
#if defined(NEEDS_NORMAL)
    vec3 tangent = abs(section_normal.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    tangent = normalizeOrZero(tangent - section_normal * dot(tangent, section_normal));
    shading_tangentToWorld = mat3(tangent, cross(section_normal, tangent), section_normal);
    shading_geometricNormal = section_normal;
    shading_normal = section_normal;
#endif
}

// After computeShadingGeometry(), before the material's code and all other derivatives.
void cutSurface() {
    section_point = pointOfMesh();
    section_right = dFdx(section_point);
    section_down = dFdy(section_point);
    if (sectionCount() > 0) {
        section_samples = samplesLeft(cuttingPlanes(), section_point);
#if defined(BLEND_MODE_OPAQUE) || defined(BLEND_MODE_MASKED) // the depth test finds the first surface of these alone
        if (!gl_FrontFacing && ofFragment(frameUniforms.section.z) > 0.0) findCap();
        if (isSectionPart(kSlabCaps))
            section_samples = section_isCap ? samplesLeft(kLeft, section_point) & ~section_samples : 0;
#endif
        section_isCut = section_samples == 0;
    }
}

highp float capDepth() {
    highp vec4 clip = frameUniforms.clipFromWorld * vec4(section_point, 1.0);
    return clip.z / clip.w;
}

// Lines in [0, width] of every period, seen through a pixel that is `size` periods wide.
highp float lineShare(highp float place, highp float width, highp float size) {
    highp float wide = max(size, 1e-4);
    highp vec2 ends = vec2(place - 0.5 * wide, place + 0.5 * wide);
    highp vec2 sums = floor(ends) * width + min(ends - floor(ends), vec2(width));
    return clamp((sums.y - sums.x) / wide, 0.0, 1.0);
}

// Hatching lines are where a cap meets sheets of one of two directions: the one that is farther from its normal.
vec3 hatched(vec3 color) {
    highp vec4 hatch = frameUniforms.sectionHatch;
    bool isSecond = abs(section_normal.x + section_normal.y + section_normal.z) > 1.5;
    highp vec3 across = vec3(1.0, isSecond ? -1.0 : 1.0, 1.0) * hatch.x;
    highp float place = dot(across, section_point) + (isSecond ? hatch.z : hatch.y);
    highp float size = abs(dot(across, section_right)) + abs(dot(across, section_down));
    return mix(color, frameUniforms.sectionHatchColor.rgb, lineShare(place, hatch.w, size));
}

// An opaque, rough surface that is no metal. Of what the material's code has set, only colours count.
void makeCap(inout MaterialInputs material) {
    vec3 color = mix(material.baseColor.rgb, frameUniforms.sectionCap.rgb, frameUniforms.sectionCap.a);
    if (ofFragment(frameUniforms.sectionHatch.x) > 0.0) color = hatched(color);
#if defined(HAS_POST_LIGHTING_COLOR)
    vec4 above = material.postLightingColor;
#endif
    initMaterial(material);
    material.baseColor = vec4(color, 1.0);
#if defined(HAS_POST_LIGHTING_COLOR)
    material.postLightingColor = above;
#endif
#if defined(HAS_CLEAR_COAT)
    material.clearCoat = 0.0;
#endif
#if defined(HAS_TRANSMISSION)
    material.transmission = 0.0;
#endif
    prepareMaterial(material);
}

// After the material's code, the mask and all derivatives.
void applySection(inout MaterialInputs material) {
    if (section_isCut) discard;
    if (section_isCap) makeCap(material);
}

#endif
