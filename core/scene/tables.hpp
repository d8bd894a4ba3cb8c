#pragma once

#include "scene/section.hpp"

#include <span>
#include <string_view>

/// What a user can set in the core's own sections, declared once. Lists of two numbers carry the unit and
/// range of each entry.
namespace talus::table {

inline constexpr double largest_coordinate = 1e9;  // m; beyond it a double cannot tell 1e-7 m

inline constexpr Parameter world[] = {
    number("origin", "m", 0, -unbounded, unbounded,
           "World coordinates of the scene's (0, 0); added to what is written, so that far-away scenes lose "
           "no digits."),
    number("gravity", "m/s2", 0, -unbounded, unbounded, "Acceleration of gravity [gx, gy]."),
    number("damping", "1/s", 0, 0, unbounded,
           "Global damping force per mass and velocity, all the run long."),
    number("base_acceleration", "m/s2", 0, -unbounded, unbounded,
           "Acceleration [ax, ay] of the ground, which may depend on time; bodies feel its opposite."),
};

inline constexpr Parameter material[] = {
    number("density", "kg/m3", required, above_zero, unbounded, "Mass per volume."),
};

inline constexpr Parameter contact[] = {
    choice(
        "roles", "symmetric|priority", 0,
        "Whether two moving bodies are master in turn, each by half, or the one of higher priority alone; a "
        "fixed body is always master."),
};

inline constexpr Parameter coordinate = number("point", "m", required, -largest_coordinate,
                                               largest_coordinate, "Coordinates [x, y] in the scene.");

inline constexpr Parameter body[] = {
    flag("fixed", false, "Whether the body stays where it is and has no unknowns."),
    flag("self_contact", false,
         "Whether parts of the body's own outline may meet; the faces of its discontinuities always may, and "
         "so may what they cut out of it."),
    number("velocity", "m/s", 0, -unbounded, unbounded, "Velocity [vx, vy] at the start."),
    number("angular_velocity", "deg/s", 0, -unbounded, unbounded,
           "Angular velocity at the start, counter-clockwise."),
    number("priority", "-", 0, -unbounded, unbounded,
           "With roles by priority the body of the higher number is master."),
};

inline constexpr Parameter blocks[] = {
    number("smallest_area", "m2", 0, 0, unbounded,
           "Blocks below it join the neighbour with which they have the longest boundary in common."),
    number("smallest_share", "-", 0, 0, 1,
           "The same as a share of the mean area before merging; the larger one counts."),
};

inline constexpr Parameter joint_set[] = {
    number("dip", "deg", required, -180, 180,
           "Angle of the joints to the x axis, counter-clockwise: joints of 30 rise to the right."),
    number("spacing", "m", required, above_zero, unbounded, "Distance between joints."),
    number("offset", "m", 0, -largest_coordinate, largest_coordinate,
           "Distance of one joint from the scene's (0, 0), to the left of the direction of the dip; so sets "
           "continue from domain to domain."),
    number("jitter", "-", 0, 0, 0.5, "Share of the spacing by which joints are moved at random, at most."),
    number("persistence", "-", 1, above_zero, 1, "Share of the length of a joint that is open."),
    number(
        "gap", "m", not_set, above_zero, unbounded,
        "Length of the bridges between the open parts of a joint, at random places; goes with a persistence "
        "below 1."),
    number("seed", "-", 0, 0, 4294967295, "Whole number from which what is random follows."),
};

inline constexpr Parameter split[] = {
    number("share", "-", required, 0, 1,
           "Share of the convex quadrilaterals, taken at random, that are split into triangles along the "
           "shorter "
           "diagonal, where none is below the smallest area."),
    number("seed", "-", 0, 0, 4294967295, "Whole number from which what is random follows."),
};

inline constexpr Parameter bricks[] = {
    number("width", "m", required, above_zero, unbounded, "Width of a brick."),
    number("height", "m", required, above_zero, unbounded, "Height of a brick."),
    choice("bond", "running|stack", 0, "Whether every second course is shifted by half a brick, or none."),
    number("gap", "m", 0, 0, unbounded, "Gap between bricks."),
};

inline constexpr Parameter voronoi[] = {
    number("count", "-", not_set, 1, unbounded, "Number of cells, around points at random."),
    number("spacing", "m", not_set, above_zero, unbounded,
           "Instead of a count: distance of points on a hexagonal grid."),
    number("jitter", "-", 0.3, 0, 0.5,
           "Share of the spacing by which each point of the grid is moved at random along x and y, at most."),
    number("seed", "-", 0, 0, 4294967295, "Whole number from which what is random follows."),
};

inline constexpr Parameter drive[] = {
    number("x", "m/s", not_set, -unbounded, unbounded, "Prescribed velocity of the centre of mass along x."),
    number("y", "m/s", not_set, -unbounded, unbounded, "Prescribed velocity of the centre of mass along y."),
    number("rotation", "deg/s", not_set, -unbounded, unbounded, "Prescribed angular velocity."),
};

/// What interfaces can say whatever law is chosen; a law declares those it reads.
inline constexpr Parameter interface[] = {
    number("normal_stiffness", "Pa/m", required, 0, unbounded, "Pressure per depth of overlap."),
    number("tangential_stiffness", "Pa/m", required, 0, unbounded, "Shear stress per slip while it sticks."),
    number("friction_angle", "deg", required, 0, 89.99995, "Angle of Coulomb friction."),
    number("cohesion", "Pa", 0, 0, unbounded, "Shear strength without pressure."),
    number("tensile_strength", "Pa", 0, 0, unbounded, "Tension at which the interface opens."),
    number("normal_damping", "-", required, 0, 10, "Normal damping as a share of critical."),
    number("tangential_damping", "-", required, 0, 10, "Tangential damping as a share of critical."),
};

inline constexpr Parameter load[] = {
    number("force", "N/m", required, -unbounded, unbounded, "Force [fx, fy] per metre of thickness."),
};

inline constexpr Parameter surface_load[] = {
    number("traction", "Pa", not_set, -unbounded, unbounded, "Traction [tx, ty] in fixed directions."),
    number("pressure", "Pa", not_set, -unbounded, unbounded,
           "Pressure towards the body; it turns with the surface."),
};

inline constexpr Parameter prescribed[] = {
    number("stiffness", "Pa/m", required, above_zero, unbounded,
           "Penalty that holds the surface (Eqs. 18-20)."),
    number("ramp", "s", 0, 0, unbounded,
           "Time over which the displacement grows to its full size, from the start or from the stage that "
           "gives it."),
    number("displacement", "m", not_set, -unbounded, unbounded,
           "Displacement [ux, uy]; null leaves an axis free."),
    number("velocity", "m/s", not_set, -unbounded, unbounded, "Velocity [vx, vy]; null leaves an axis free."),
};

inline constexpr Parameter settle[] = {
    number("duration", "s", required, above_zero, unbounded,
           "How long the scene settles before t = 0, at most."),
    number("damping", "1/s", required, above_zero, unbounded,
           "Global damping while it settles; twice the angular frequency of the slowest oscillation is "
           "critical."),
    number("until", "-", not_set, above_zero, 1,
           "Ratio of unbalanced to applied force at which it ends before its duration."),
    flag("hold_stick", true,
         "Whether friction bears whatever it is asked to while "
         "the scene settles; at t = 0 it is cut to its limit."),
};

inline constexpr Parameter stage[] = {
    number("from", "s", required, above_zero, unbounded, "Time from which its values hold."),
};

/// Of the critical step of contacts and supports: above it a bounce gains or loses a tenth of its speed.
inline constexpr double safety_with_contact = 0.4;

inline constexpr Parameter time[] = {
    number("end", "s", required, above_zero, unbounded, "When the run ends."),
    number("dt", "s", automatic, above_zero, unbounded,

           "Time step; \"auto\" takes it from votes of bodies and contacts. Output times are met exactly."),
    number("safety", "-", 0.2, above_zero, 0.9,
           "The automatic step is min(safety · critical step of undamped contacts and supports alone, "
           "max(0.8, safety) · that of the whole scene), and safety · the latter without any; at most 0.4 "
           "where bodies can meet."),
};

inline constexpr Parameter sleep[] = {
    number("speed", "m/s", 1e-5, above_zero, unbounded, "Speed that no corner of a body at rest reaches."),
    number("acceleration", "m/s2", 1e-3, above_zero, unbounded,
           "Largest acceleration of a corner with which bodies may be put to sleep."),
    number("after", "s", 0.05, above_zero, unbounded,
           "How long all bodies of an island have to be at rest before it sleeps."),
};

inline constexpr Parameter output[] = {
    number("history", "s", not_set, above_zero, unbounded,
           "Interval of the history; a 500th of the run if left out, or a little less to divide the frames' "
           "interval."),
    number("frames", "s", not_set, above_zero, unbounded,
           "Interval of the frames, a whole multiple of that of the history; none if left out."),
};

inline constexpr Parameter limits[] = {
    number("energy_residual", "-", 0.05, above_zero, unbounded,
           "Share of the energy throughput that may go missing before a run stops; it warns at 0.01."),
    number("penetration", "-", 0.3, above_zero, unbounded,
           "Share of the smallest width of a body, or of the size of its elements where that is less, that "
           "an overlap may reach before a run stops."),
};

inline constexpr Parameter tolerance[] = {
    choice("against", "baseline|reference", 0, "Whether the first run or the reference file is right."),
    number("largest", "-", not_set, 0, unbounded, "Largest deviation allowed, in the unit of the quantity."),
    number("rms", "-", not_set, 0, unbounded, "Root mean square of the deviation allowed."),
    number("final", "-", not_set, 0, unbounded, "Deviation allowed at the end."),
};

/// A parameter by its key; a key that the table does not hold does not compile.
consteval const Parameter& of(std::span<const Parameter> parameters, std::string_view key) {
  for (const Parameter& parameter : parameters) {
    if (parameter.key == key) return parameter;
  }
  throw "no such key";
}

}  // namespace talus::table
