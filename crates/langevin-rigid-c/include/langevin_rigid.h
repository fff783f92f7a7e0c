/*
 * C interface of Langevin Rigid's run time: light bodies that move through air and water.
 *
 * SI units, angles in radians. The world is right-handed with +Y up, unless gravity says otherwise. Forces, torques and
 * flows are in the world frame, torques about the centre of mass. The body frame has its origin at the centre of mass;
 * plates and discs have their thin axis along y. Quaternions are x, y, z, w and turn body vectors into world vectors.
 *
 * Pointers. What is created through `out` is a handle, freed by the free function of its type, once; it is NULL where the
 * call failed. All other pointers stay the caller's. Each must point to memory of its type that nobody else writes to
 * during the call, nor reads if the call writes to it; texts end with a NUL, and arrays are as long as the count beside
 * them. NULL is refused where the function does not say what it means.
 *
 * Failures. A call that can fail returns an lr_status; one that fails changes nothing, but for lr_stepper_step_many and for
 * a handle that it makes NULL. lr_last_error says in words what was wrong. No call ends the process, and none prints but for
 * a fault of the library.
 *
 * The same state, input and step have the same bits on every platform, and the same as in Rust.
 */


#ifndef LANGEVIN_RIGID_H
#define LANGEVIN_RIGID_H

/* Written by cbindgen from the sources of langevin-rigid-c: UPDATE=1 cargo test -p langevin-rigid-c --test header */

#include <stddef.h>
#include <stdint.h>

/**
 * Version of this interface: it changes when a struct or a function does so that programs must be compiled again.
 */
#define LR_ABI_VERSION 1

/**
 * What a call came to. `lr_last_error` says in words what was wrong and how to mend it.
 */
typedef enum lr_status {
    /**
     * All is well.
     */
    LR_STATUS_OK = 0,
    /**
     * A pointer is NULL that must not be, or not aligned for what it points to.
     */
    LR_STATUS_POINTER = 1,
    /**
     * A number is not finite or out of its range, a size is too large, or a choice is none.
     */
    LR_STATUS_ARGUMENT = 2,
    /**
     * A file cannot be read.
     */
    LR_STATUS_FILE = 3,
    /**
     * The bytes are no bake, or a damaged one.
     */
    LR_STATUS_BAKE = 4,
    /**
     * Body, fluid and settings do not go together.
     */
    LR_STATUS_SETUP = 5,
    /**
     * The state that a step was to start from is impossible.
     */
    LR_STATUS_STATE = 6,
    /**
     * The step would have left the state infinite or faster than possible.
     */
    LR_STATUS_DIVERGED = 7,
    /**
     * A fault of the library; please report it.
     */
    LR_STATUS_INTERNAL = 8,
} lr_status;

/**
 * How the equations of motion are read.
 */
typedef enum lr_model {
    /**
     * Kirchhoff's equations with the closure for separated flow: bodies flutter and tumble. The default.
     */
    LR_MODEL_SEPARATED = 0,
    /**
     * Kirchhoff's equations with Langevin loads through the added mass: the method of Xie & Miyata (2014), dimensionally
     * sound.
     */
    LR_MODEL_CONSISTENT = 1,
    /**
     * Potential flow alone, without turbulence.
     */
    LR_MODEL_KIRCHHOFF = 2,
    /**
     * Eqs. (11) and (12) of Xie & Miyata (2014) to the letter, in centimetres, grams and seconds.
     */
    LR_MODEL_PUBLISHED = 3,
    /**
     * The same in SI units.
     */
    LR_MODEL_PUBLISHED_SI = 4,
} lr_model;

/**
 * Where the turbulence comes from.
 */
typedef enum lr_turbulence {
    /**
     * Born at the body, all along its way. The default.
     */
    LR_TURBULENCE_BODY_DRIVEN = 0,
    /**
     * From the history in the bake, by the time since release.
     */
    LR_TURBULENCE_HISTORY = 1,
} lr_turbulence;

/**
 * A rigid body: its mass, its added mass, and what flow makes of its shape. Its frame has the origin at the centre of mass
 * and the axes of the mesh that it was made from.
 *
 * Several threads may read it at a time.
 */
typedef struct lr_body lr_body;

/**
 * A body in a fluid under settings. It is made once and steps any number of bodies of that shape; it holds no state, so
 * several threads may use it at a time.
 */
typedef struct lr_stepper lr_stepper;

/**
 * The velocity of the fluid wherever and whenever a body may be: the sum of any number of fields. Several threads may ask
 * it for the flow at a time, but for one that adds to it.
 */
typedef struct lr_wind lr_wind;

/**
 * A vector.
 */
typedef struct lr_vec3 {
    /**
     * Along x.
     */
    double x;
    /**
     * Along y.
     */
    double y;
    /**
     * Along z.
     */
    double z;
} lr_vec3;

/**
 * A matrix, by rows.
 */
typedef struct lr_mat3 {
    /**
     * First row.
     */
    struct lr_vec3 x;
    /**
     * Second row.
     */
    struct lr_vec3 y;
    /**
     * Third row.
     */
    struct lr_vec3 z;
} lr_mat3;

/**
 * What a body is in numbers.
 */
typedef struct lr_body_properties {
    /**
     * Mass (kg).
     */
    double mass;
    /**
     * Volume (m^3).
     */
    double volume;
    /**
     * Inertia about the centre of mass, body frame (kg m^2).
     */
    struct lr_mat3 inertia;
    /**
     * Centre of buoyancy, from the centre of mass, body frame (m).
     */
    struct lr_vec3 centre_of_buoyancy;
    /**
     * Half the extents along the principal axes of the volume, descending (m).
     */
    struct lr_vec3 half_extents;
} lr_body_properties;

/**
 * A homogeneous fluid, at rest or in uniform steady motion.
 */
typedef struct lr_fluid {
    /**
     * Density (kg/m^3).
     */
    double density;
    /**
     * Kinematic viscosity (m^2/s).
     */
    double viscosity;
    /**
     * Uniform wind or current, world frame (m/s).
     */
    struct lr_vec3 velocity;
} lr_fluid;

/**
 * Choices of a run. `lr_settings_default` fills them with what a new user should have.
 */
typedef struct lr_settings {
    /**
     * Gravity, world frame (m/s^2).
     */
    struct lr_vec3 gravity;
    /**
     * Speed relative to the fluid at which the body is let go (m/s): the Reynolds number of its turbulence is on it where
     * it is faster than the body falls.
     */
    double release_speed;
    /**
     * The longest part that a step is taken in, over the shortest time in which the motion changes: 1 resolves it; up to 1.6
     * it is coarser and faster, and stable, for bodies seen from afar.
     */
    double longest_part;
    /**
     * One of `lr_model`.
     */
    int32_t model;
    /**
     * One of `lr_turbulence`.
     */
    int32_t turbulence;
} lr_settings;

/**
 * An orientation: a unit quaternion that turns vectors of the body into vectors of the world. The scalar part is last.
 */
typedef struct lr_quat {
    /**
     * Sine of half the angle times the axis, along x.
     */
    double x;
    /**
     * The same along y.
     */
    double y;
    /**
     * The same along z.
     */
    double z;
    /**
     * Cosine of half the angle.
     */
    double w;
} lr_quat;

/**
 * Pose and velocities of a body at a time. The velocities are in the body frame, where the equations are:
 * `lr_state_set_world_velocities` and `lr_state_get_world_velocities` convert them.
 */
typedef struct lr_state {
    /**
     * Time since release (s).
     */
    double time;
    /**
     * Steps taken since release; selects the noise of the next one.
     */
    uint64_t step;
    /**
     * Position of the centre of mass, world frame (m).
     */
    struct lr_vec3 position;
    /**
     * Orientation, body to world.
     */
    struct lr_quat orientation;
    /**
     * Velocity of the centre of mass, body frame (m/s).
     */
    struct lr_vec3 velocity;
    /**
     * Angular velocity, body frame (rad/s).
     */
    struct lr_vec3 angular_velocity;
    /**
     * Turbulence that the body sees under `LR_MODEL_SEPARATED`, world frame: velocity of the fluid in units of its standard
     * deviation. Zero at release; steps change it.
     */
    struct lr_vec3 fluctuation;
    /**
     * The same of the rotation rate of the fluid.
     */
    struct lr_vec3 fluctuation_spin;
} lr_state;

/**
 * The fluid around a body as it would be without it, on top of the velocity of `lr_fluid`.
 */
typedef struct lr_flow {
    /**
     * Velocity u at the centre of mass, world frame (m/s).
     */
    struct lr_vec3 velocity;
    /**
     * Its gradient there, world frame (1/s): row i has the derivatives of u_i along x, y and z, so a wind along x that grows
     * with height has a positive `gradient.x.y`.
     */
    struct lr_mat3 gradient;
    /**
     * Material acceleration Du/Dt there, world frame (m/s^2): the push of a wind that changes in time.
     */
    struct lr_vec3 acceleration;
} lr_flow;

/**
 * A force and a torque.
 */
typedef struct lr_wrench {
    /**
     * Force, world frame (N).
     */
    struct lr_vec3 force;
    /**
     * Torque about the centre of mass, world frame (N m).
     */
    struct lr_vec3 torque;
} lr_wrench;

/**
 * What acts on a body over one step. All zero is fluid at rest, no wrench, and the first noise of seed 0.
 */
typedef struct lr_input {
    /**
     * The fluid around the body.
     */
    struct lr_flow flow;
    /**
     * What else acts on it: contacts, strings, thrusters.
     */
    struct lr_wrench wrench;
    /**
     * Seed of the noise: that of a run.
     */
    uint64_t seed;
    /**
     * Number of the body: bodies with different numbers have different noise.
     */
    uint32_t body;
} lr_input;

/**
 * What acts on a body, by cause: forces and torques about the centre of mass, world frame.
 */
typedef struct lr_loads {
    /**
     * Gravity on the mass of the body.
     */
    struct lr_wrench weight;
    /**
     * Buoyancy at the centre of the displaced volume.
     */
    struct lr_wrench buoyancy;
    /**
     * Kirchhoff's term of the added mass: the couple that turns a body broadside to its way.
     */
    struct lr_wrench added_mass;
    /**
     * Pressure drag and skin friction.
     */
    struct lr_wrench drag;
    /**
     * Normal force of a body at incidence.
     */
    struct lr_wrench normal_force;
    /**
     * Lift of the circulation that comes with spin.
     */
    struct lr_wrench rotational_lift;
    /**
     * Resistance of the pressure to spin.
     */
    struct lr_wrench damping;
    /**
     * What separation takes from the couple of the added mass.
     */
    struct lr_wrench lost_couple;
    /**
     * Viscous resistance (Stokes).
     */
    struct lr_wrench friction;
    /**
     * Mean load of the turbulence, in the models that have it.
     */
    struct lr_wrench turbulence;
    /**
     * Push of a fluid that accelerates.
     */
    struct lr_wrench fluid_acceleration;
    /**
     * The wrench of the input.
     */
    struct lr_wrench outside;
    /**
     * All together.
     */
    struct lr_wrench sum;
} lr_loads;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * Version of the library, such as "0.1.0". The text is the library's and lasts.
 */
const char *lr_version(void);

/**
 * `LR_ABI_VERSION` of the library that was linked: a program that loads it compares this with the one of its header.
 */
uint32_t lr_abi_version(void);

/**
 * What was wrong with the last call of this thread that failed, in English; empty if none has. The text is the library's and
 * lasts until another call of this thread fails.
 */
const char *lr_last_error(void);

/**
 * A body from the bytes of a bake: the file that the command `langevin-rigid bake` writes. The turbulence that it has is
 * kept for the source `LR_TURBULENCE_HISTORY`.
 *
 * `LR_STATUS_BAKE` if it is none. The bytes are not needed afterwards.
 */
enum lr_status lr_body_from_bake(const uint8_t *bytes,
                                 size_t length,
                                 struct lr_body **out);

/**
 * A body from a bake file, whose path is in UTF-8: see `lr_body_from_bake`.
 *
 * `LR_STATUS_FILE` if the file cannot be read, `LR_STATUS_BAKE` if it is no bake.
 */
enum lr_status lr_body_load(const char *path, struct lr_body **out);

/**
 * A homogeneous sphere of this radius (m) and density (kg/m^3).
 */
enum lr_status lr_body_sphere(double radius, double density, struct lr_body **out);

/**
 * A homogeneous ellipsoid with these semi-axes along x, y and z of its frame (m) and this density (kg/m^3).
 */
enum lr_status lr_body_ellipsoid(struct lr_vec3 semi_axes, double density, struct lr_body **out);

/**
 * A homogeneous disc of this radius and thickness (m) and density (kg/m^3), its axis along y of its frame.
 */
enum lr_status lr_body_disc(double radius, double thickness, double density, struct lr_body **out);

/**
 * A homogeneous flat plate of this length along x, width along z and thickness along y of its frame (m) and this density
 * (kg/m^3).
 */
enum lr_status lr_body_plate(double length,
                             double width,
                             double thickness,
                             double density,
                             struct lr_body **out);

/**
 * A homogeneous circular cylinder of this radius and length (m) and density (kg/m^3), its axis along x of its frame.
 */
enum lr_status lr_body_cylinder(double radius, double length, double density, struct lr_body **out);

/**
 * A homogeneous box with these edges along x, y and z of its frame (m) and this density (kg/m^3).
 */
enum lr_status lr_body_cuboid(struct lr_vec3 size, double density, struct lr_body **out);

/**
 * Gives the hull other contents: this mass (kg), this centre of mass, from the present one in the body frame (m), and this
 * inertia about the new one (kg m^2). The origin of the frame moves to the new centre of mass; steppers that were made of
 * the body stay as they are. On failure the body is left as it was.
 */
enum lr_status lr_body_set_mass_properties(struct lr_body *body,
                                           double mass,
                                           struct lr_vec3 centre_of_mass,
                                           struct lr_mat3 inertia);

/**
 * Mass, volume, inertia and size of a body.
 */
enum lr_status lr_body_get_properties(const struct lr_body *body, struct lr_body_properties *out);

/**
 * Frees a body; NULL is none. Steppers that were made of it stay.
 */
void lr_body_free(struct lr_body *body);

/**
 * Air at 20 degrees Celsius and sea level, at rest.
 */
struct lr_fluid lr_fluid_air(void);

/**
 * Fresh water at 20 degrees Celsius, at rest.
 */
struct lr_fluid lr_fluid_water(void);

/**
 * Earth's gravity along -y, the model `LR_MODEL_SEPARATED`, turbulence of the body's own, steps that resolve the motion.
 */
struct lr_settings lr_settings_default(void);

/**
 * At rest at the origin, body axes along the world's.
 */
struct lr_state lr_state_default(void);

/**
 * Sets both velocities from the world frame (m/s, rad/s), by the orientation that the state has.
 */
enum lr_status lr_state_set_world_velocities(struct lr_state *state,
                                             struct lr_vec3 velocity,
                                             struct lr_vec3 angular_velocity);

/**
 * Both velocities in the world frame (m/s, rad/s). Either place may be NULL.
 */
enum lr_status lr_state_get_world_velocities(const struct lr_state *state,
                                             struct lr_vec3 *velocity,
                                             struct lr_vec3 *angular_velocity);

/**
 * Fluid at rest, no wrench, seed 0, body 0.
 */
struct lr_input lr_input_default(void);

/**
 * Makes a body ready to step in a fluid. NULL settings are `lr_settings_default`. Body, fluid and settings are not needed
 * afterwards.
 *
 * `LR_STATUS_SETUP` if they do not go together.
 */
enum lr_status lr_stepper_new(const struct lr_body *body,
                              const struct lr_fluid *fluid,
                              const struct lr_settings *settings,
                              struct lr_stepper **out);

/**
 * Frees a stepper; NULL is none.
 */
void lr_stepper_free(struct lr_stepper *stepper);

/**
 * Advances a state by `dt` (s). The input stays what it is over the step; NULL is `lr_input_default`. A step of any length
 * is stable, and allocates nothing.
 *
 * On failure the state is left as it was: `LR_STATUS_STATE` if it was impossible, `LR_STATUS_ARGUMENT` if `dt` or the
 * input is, `LR_STATUS_DIVERGED` if the step would have made it so.
 */
enum lr_status lr_stepper_step(const struct lr_stepper *stepper,
                               struct lr_state *state,
                               double dt,
                               const struct lr_input *input);

/**
 * Advances `count` states by `dt` (s), each under its own input. NULL inputs are fluid at rest, no wrench, seed 0 and the
 * index as the number of the body.
 *
 * It stops at the first failure, whose index `lr_last_error` names: the states before it have taken their step, that one
 * and those after it have not. Threads may step parts of the states at a time.
 */
enum lr_status lr_stepper_step_many(const struct lr_stepper *stepper,
                                    struct lr_state *states,
                                    size_t count,
                                    double dt,
                                    const struct lr_input *inputs);

/**
 * What acts on the body in a state under an input, by cause; a NULL input is `lr_input_default`.
 */
enum lr_status lr_stepper_loads(const struct lr_stepper *stepper,
                                const struct lr_state *state,
                                const struct lr_input *input,
                                struct lr_loads *out);

/**
 * The longest step (s) that a body in this state takes whole; a longer one is taken in parts, which cost as much each.
 * Infinite for a body at rest without friction.
 */
enum lr_status lr_stepper_longest_step(const struct lr_stepper *stepper, const struct lr_state *state, double *out);

/**
 * A wind without any field.
 */
enum lr_status lr_wind_new(struct lr_wind **out);

/**
 * Frees a wind; NULL is none.
 */
void lr_wind_free(struct lr_wind *wind);

/**
 * Adds the same velocity everywhere (m/s), world frame.
 */
enum lr_status lr_wind_add_uniform(struct lr_wind *wind, struct lr_vec3 velocity);

/**
 * Adds wind that grows with this power of the height (1/7 over open land): `velocity` (m/s, world frame) at `height` (m)
 * above a ground at world y `ground` (m), below which there is none.
 */
enum lr_status lr_wind_add_power_shear(struct lr_wind *wind,
                                       struct lr_vec3 velocity,
                                       double height,
                                       double ground,
                                       double exponent);

/**
 * Adds wind that grows with ln(1 + height/roughness), for a roughness length (m) of 0.03 in grass or 0.001 on a floor; the
 * rest as in `lr_wind_add_power_shear`.
 */
enum lr_status lr_wind_add_log_shear(struct lr_wind *wind,
                                     struct lr_vec3 velocity,
                                     double height,
                                     double ground,
                                     double roughness);

/**
 * Adds homogeneous isotropic turbulence of von Karman's spectrum: `rms` of each component of the velocity (m/s), integral
 * length scale `length` (m), size of the smallest eddies `smallest` (m; 0 for a fiftieth of the length), the velocity that
 * carries them (m/s, world frame), and which of all such fields it is, `seed`.
 */
enum lr_status lr_wind_add_gusts(struct lr_wind *wind,
                                 double rms,
                                 double length,
                                 double smallest,
                                 struct lr_vec3 carried,
                                 uint64_t seed);

/**
 * Adds a straight line through `centre` (m, world frame) along `axis`, of any length, about which the fluid turns
 * counter-clockwise, seen from the axis' tip: circulation (m^2/s) and radius of the viscous core (m).
 */
enum lr_status lr_wind_add_vortex(struct lr_wind *wind,
                                  struct lr_vec3 centre,
                                  struct lr_vec3 axis,
                                  double circulation,
                                  double core);

/**
 * Adds what a fan blows: from `centre` (m, world frame) along `axis`, of any length, at `speed` (m/s) in the middle of a fan
 * of this diameter (m).
 */
enum lr_status lr_wind_add_jet(struct lr_wind *wind,
                               struct lr_vec3 centre,
                               struct lr_vec3 axis,
                               double speed,
                               double diameter);

/**
 * The fluid at a position (m, world frame) and a time (s), for the input of a body there.
 *
 * `stream` (m/s) is the velocity of the body's `lr_fluid`, which the wind comes on top of: it is not in the velocity that
 * comes out, but carries the wind along, which counts for its acceleration.
 */
enum lr_status lr_wind_flow(const struct lr_wind *wind,
                            struct lr_vec3 position,
                            double time,
                            struct lr_vec3 stream,
                            struct lr_flow *out);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* LANGEVIN_RIGID_H */
