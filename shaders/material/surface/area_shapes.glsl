// SPDX-License-Identifier: Apache-2.0
// Rectangles, discs and tubes among the lights of a view, and the integral of their light over a hemisphere.
// quality_areaLights is 0 in a view without them, and then none of this is in the program.

// The shape in the light list (LightShape of ShaderInterface.h).
const float kShapeSpot = 1.0;
const float kShapeDisc = 3.0;
const float kShapeTube = 4.0;
const float kShapeTwoSided = 4.0; // added to rectangles and discs: 6 and 7
const float kShapeImaged = 8.0; // times the place of its image, added to a rectangle
const float kFullestTube = 0.0625; // of a tube's distance from its axis, as seen from inside: at most 4 times its width

struct AreaLight {
    highp vec3 center;       // from the point that is shaded
    highp vec3 halfX, halfY; // their cross product points away from a point that it shines on
    highp vec3 luminance;    // pre-exposed
    highp vec3 visibility;   // [0, 1]: visibility from shadow maps
    highp vec3 color, mirrored; // of the image, as the diffuse and the specular lobe see it; 1 without one
    bool isDisc;
    bool isTwoSided;
};

// A surface: z is its normal, and the view is in the plane of x and z.
struct AreaFrame {
    highp vec3 x, y, z;
};

bool isArea(highp float shape) { return shape > kShapeSpot + 0.5; }

// The rectangle that covers a tube as seen from a point: between the two tangent planes of the cylinder through the point.
// halfAxis: from the middle to an end.
highp vec3 tubeAcross(highp vec3 center, highp vec3 halfAxis, highp float radius) {
    highp vec3 across = cross(center, halfAxis);
    highp float length = dot(across, across);
    highp float square = length / max(dot(halfAxis, halfAxis), 1e-30); // distance from the axis
    highp float open = max(square - radius * radius, kFullestTube * square);
    return across * (radius * sqrt(square / max(open, 1e-30) / max(length, 1e-30)));
}

// The light at a place of the list, from the point that is shaded.
AreaLight areaLightAt(int index, highp vec3 center, highp vec4 colorIntensity) {
    highp vec4 xAndMore = lightBuffer.lights[index].directionScale;
    highp vec4 more = lightBuffer.lights[index].offset;
    highp float shape = colorIntensity.w;
    if ((quality_lightImages & kAreaImages) != 0) shape -= kShapeImaged * floor(shape / kShapeImaged);
    AreaLight area;
    area.center = center;
    area.halfX = xAndMore.xyz;
    area.halfY = vec3(xAndMore.w, more.x, more.w);
    if (shape == kShapeTube) area.halfY = tubeAcross(center, area.halfX, xAndMore.w);
    area.isTwoSided = shape > kShapeTube;
    area.isDisc = shape == kShapeDisc || shape == kShapeDisc + kShapeTwoSided;
    area.luminance = colorIntensity.rgb;
    area.color = vec3(1.0);
    area.mirrored = vec3(1.0);
    area.visibility = vec3(1.0);
    return area;
}

highp vec3 inFrame(AreaFrame frame, highp vec3 v) {
    return vec3(dot(frame.x, v), dot(frame.y, v), dot(frame.z, v));
}

// Any x, if the view is along the normal.
AreaFrame areaFrame(highp vec3 normal, highp vec3 view) {
    highp vec3 axis = normal.x * normal.x < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
    highp vec3 inPlane = view - normal * dot(normal, view);
    if (dot(inPlane, inPlane) < 1e-8) inPlane = axis - normal * dot(normal, axis);
    AreaFrame frame;
    frame.x = inPlane / sqrt(max(dot(inPlane, inPlane), 1e-20));
    frame.y = cross(normal, frame.x);
    frame.z = normal;
    return frame;
}

AreaFrame behindOf(AreaFrame frame) {
    frame.y = -frame.y;
    frame.z = -frame.z;
    return frame;
}

// areaIntegral() of the side that shines; 0 if it faces away. The vectors: those of the light in a frame, and maybe
// transformed.
highp vec3 shiningIntegral(AreaLight area, highp vec3 center, highp vec3 halfX, highp vec3 halfY) {
    highp vec3 integral = areaIntegral(center, halfX, halfY, area.isDisc);
    if (area.isTwoSided && integral.z < 0.0) integral = -integral;
    return integral.z > 0.0 ? integral : vec3(0.0);
}

// Where a lobe sees the image of a rectangle, in xy, and how much of it, in z: a standard deviation over the root of the
// area. axis: of the lobe, any length. spread: its standard deviation a distance.
// After Heitz, Dupuy, Hill and Neubelt 2016, section 5, who take the point's projection onto the area for every lobe.
highp vec3 placeOnArea(AreaLight area, highp vec3 axis, highp float spread) {
    highp vec3 normal = cross(area.halfX, area.halfY);
    highp float away = dot(area.center, normal);
    if (dot(axis, normal) * away <= 0.0) axis = normal; // it does not meet the plane
    highp vec3 onPlane = axis * (away / max(abs(dot(axis, normal)), 1e-30));
    if (dot(axis, normal) < 0.0) onPlane = -onPlane;
    onPlane -= area.center;
    highp vec2 square = vec2(dot(area.halfX, area.halfX), dot(area.halfY, area.halfY));
    highp vec2 at = clamp(vec2(dot(onPlane, area.halfX), dot(onPlane, area.halfY)) / max(square, vec2(1e-30)), vec2(-1.0), vec2(1.0));
    highp vec3 nearest = area.halfX * at.x + area.halfY * at.y;
    highp vec3 beside = onPlane - nearest; // a lobe that misses the rectangle sees more of it
    nearest += area.center;
    highp float blur = spread * sqrt(dot(nearest, nearest)) + 0.5 * sqrt(dot(beside, beside));
    return vec3(0.5 - 0.5 * at, blur * 0.5 / sqrt(max(sqrt(square.x * square.y), 1e-30)));
}

highp vec3 integralOver(AreaFrame frame, AreaLight area) {
    return shiningIntegral(
            area, inFrame(frame, area.center), inFrame(frame, area.halfX), inFrame(frame, area.halfY));
}
