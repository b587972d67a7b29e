// SPDX-License-Identifier: Apache-2.0
// Where a direction lies in the table of a light profile (filament_core/assets/tables/LightProfileTable.h).
//   Space     that of the profile: x and y across, z the cosine to forward; the direction is unit.
//   Accuracy  angles within 4e-7 radians: the drivers' own arc functions differ by more, and from each other.
//   fp32 only.

// The arc tangent of x in [0, 1], within 2e-8 except for rounding. Abramowitz and Stegun 1964, 4.4.49.
float arcTangentOfUnit(float x) {
    float s = x * x;
    float high = 0.1065626393f + s * (-0.0752896400f + s * (0.0429096138f + s * (-0.0161657367f + s * 0.0028662257f)));
    return x * (1.0f + s * (-0.3333314528f + s * (0.1999355085f + s * (-0.1420889944f + s * high))));
}

// The angle from (1, 0) to (along, across), across >= 0: [0, pi]. Any length; 0 for none.
float angleFrom(float along, float across) {
    float beside = max(along, -along);
    float least = min(across, beside);
    float most = max(across, beside);
    float angle = arcTangentOfUnit(least / max(most, 1e-30f));
    if (across > beside) angle = 0.5f * kPi - angle;
    return along < 0.0f ? kPi - angle : angle;
}

// x: row, y: column in [0, columns], both with what is beyond the last whole one.
vec2 profilePlace(vec3 direction, float rowsPerRadian, float columns) {
    float polar = angleFrom(direction.z, sqrt(direction.x * direction.x + direction.y * direction.y));
    float turn = angleFrom(direction.x, max(direction.y, -direction.y)) * (0.5f * kInversePi);
    if (direction.y < 0.0f) turn = 1.0f - turn;
    return vec2(polar * rowsPerRadian, turn * columns);
}
