// Colours of all drawings of a gate: dark on a light background. Each colour has one meaning.
#pragma once

namespace gearshift::base {

inline constexpr const char* kInk = "#1f2933";
inline constexpr const char* kSoftInk = "#6b7785";
inline constexpr const char* kGridInk = "#d5dbe1";
inline constexpr const char* kPlateColour = "#dfe4ea";
inline constexpr const char* kFreeColour = "#fbfcfd";
inline constexpr const char* kAisleShade = "#e6eaef";
inline constexpr const char* kMouthShade = "#f1f3f6";
inline constexpr const char* kGearColour = "#1f5fa8";
inline constexpr const char* kBufferColour = "#e8a33d";
inline constexpr const char* kBufferGround = "#fdf3e1";
inline constexpr const char* kClosedColour = "#8a5a00";
inline constexpr const char* kLockoutColour = "#c5303b";
inline constexpr const char* kShortDash = "0.8 0.8";

}  // namespace gearshift::base
