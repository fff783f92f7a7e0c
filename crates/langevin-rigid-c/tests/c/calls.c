/* Reads the bake at the first path, steps it, and tries every wrong input. The second path is no file, the third no bake. */

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "langevin_rigid.h"

#define BODIES 5

static int faults = 0;

static void expect(int line, lr_status status, lr_status wanted, const char *words) {
    const char *said = wanted == LR_STATUS_OK ? "" : lr_last_error();
    if (status != wanted || strstr(said, words) == NULL) {
        ++faults;
        fprintf(stderr, "line %d: status %d for %d, `%s` for `%s`\n", line, (int)status, (int)wanted, lr_last_error(), words);
    }
}

#define OK(call) expect(__LINE__, call, LR_STATUS_OK, "")
#define FAILS(call, status, words) expect(__LINE__, call, status, words)

#define HOLDS(what)                                             \
    do {                                                        \
        if (!(what)) {                                          \
            ++faults;                                           \
            fprintf(stderr, "line %d: not %s\n", __LINE__, #what); \
        }                                                       \
    } while (0)

/* A state has no padding, so equal states have equal bytes. */
static int same(const lr_state *a, const lr_state *b) { return memcmp(a, b, sizeof *a) == 0; }

static void print(const lr_state *state) {
    printf("%.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g\n", state->time, state->position.x, state->position.y,
           state->position.z, state->velocity.x, state->velocity.y, state->velocity.z, state->fluctuation_spin.z);
}

/* Every byte of the file. */
static unsigned char *bytes_of(const char *path, size_t *length) {
    FILE *file = fopen(path, "rb");
    if (file == NULL || fseek(file, 0, SEEK_END) != 0) {
        perror(path);
        exit(EXIT_FAILURE);
    }
    *length = (size_t)ftell(file);
    rewind(file);
    unsigned char *bytes = malloc(*length);
    if (bytes == NULL || fread(bytes, 1, *length, file) != *length) {
        perror(path);
        exit(EXIT_FAILURE);
    }
    fclose(file);
    return bytes;
}

static void bodies(const char *bake, const char *missing, const char *foreign) {
    lr_body *body = (lr_body *)&faults;
    FAILS(lr_body_load(missing, &body), LR_STATUS_FILE, missing);
    HOLDS(body == NULL);
    FAILS(lr_body_load(foreign, &body), LR_STATUS_BAKE, foreign);
    FAILS(lr_body_load(foreign, &body), LR_STATUS_BAKE, "not a Langevin Rigid bake");
    FAILS(lr_body_load(NULL, &body), LR_STATUS_POINTER, "`path` is NULL");
    FAILS(lr_body_load("\xff", &body), LR_STATUS_ARGUMENT, "UTF-8");
    FAILS(lr_body_load(bake, NULL), LR_STATUS_POINTER, "`out` is NULL");

    size_t length;
    unsigned char *bytes = bytes_of(bake, &length);
    FAILS(lr_body_from_bake(bytes, length - 1, &body), LR_STATUS_BAKE, "bytes long");
    FAILS(lr_body_from_bake(bytes, 0, &body), LR_STATUS_BAKE, "not a Langevin Rigid bake");
    FAILS(lr_body_from_bake(NULL, length, &body), LR_STATUS_POINTER, "`bytes` is NULL");
    FAILS(lr_body_from_bake(bytes, (size_t)-1, &body), LR_STATUS_ARGUMENT, "count");
    bytes[length / 2] ^= 1;
    FAILS(lr_body_from_bake(bytes, length, &body), LR_STATUS_BAKE, "checksum");
    HOLDS(body == NULL);
    bytes[length / 2] ^= 1;
    OK(lr_body_from_bake(bytes, length, &body));
    HOLDS(body != NULL);
    lr_body_free(body);
    free(bytes);

    lr_vec3 size = {0.1, 0.2, 0.3}, flat = {0.1, 0.0, 0.3}, lost = {NAN, 0.0, 0.0}, here = {0.0, 0.0, 0.0};
    FAILS(lr_body_sphere(0.0, 1.0, &body), LR_STATUS_ARGUMENT, "radius");
    FAILS(lr_body_sphere(1.0, NAN, &body), LR_STATUS_ARGUMENT, "density");
    FAILS(lr_body_ellipsoid(flat, 1.0, &body), LR_STATUS_ARGUMENT, "semi-axis along y");
    FAILS(lr_body_disc(1.0, INFINITY, 1.0, &body), LR_STATUS_ARGUMENT, "thickness");
    FAILS(lr_body_plate(1.0, -1.0, 0.1, 1.0, &body), LR_STATUS_ARGUMENT, "width");
    FAILS(lr_body_cylinder(1.0, 0.0, 1.0, &body), LR_STATUS_ARGUMENT, "length");
    FAILS(lr_body_cuboid(flat, 1.0, &body), LR_STATUS_ARGUMENT, "size along y");
    FAILS(lr_body_sphere(1.0, 1.0, NULL), LR_STATUS_POINTER, "`out` is NULL");
    HOLDS(body == NULL);
    OK(lr_body_ellipsoid(size, 1.0, &body));
    lr_body_free(body);
    OK(lr_body_disc(0.1, 0.01, 1.0, &body));
    lr_body_free(body);
    OK(lr_body_cylinder(0.1, 0.3, 1.0, &body));
    lr_body_free(body);
    OK(lr_body_sphere(0.1, 1.0, &body));
    lr_body_free(body);

    lr_body_properties is, was;
    OK(lr_body_cuboid(size, 500.0, &body));
    OK(lr_body_get_properties(body, &was));
    HOLDS(fabs(was.mass - 3.0) < 1e-12 && fabs(was.volume - 0.006) < 1e-15);
    HOLDS(fabs(was.inertia.x.x - 3.0 / 12.0 * (0.04 + 0.09)) < 1e-12 && was.inertia.x.y == 0.0);
    FAILS(lr_body_set_mass_properties(body, -1.0, here, was.inertia), LR_STATUS_ARGUMENT, "mass");
    FAILS(lr_body_set_mass_properties(body, 1.0, lost, was.inertia), LR_STATUS_ARGUMENT, "centre of mass");
    FAILS(lr_body_set_mass_properties(NULL, 1.0, here, was.inertia), LR_STATUS_POINTER, "`body` is NULL");
    lr_mat3 none = {{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
    FAILS(lr_body_set_mass_properties(body, 1.0, here, none), LR_STATUS_ARGUMENT, "inertia");
    OK(lr_body_get_properties(body, &is));
    HOLDS(is.mass == was.mass);
    lr_vec3 keel = {0.0, -0.02, 0.0};
    OK(lr_body_set_mass_properties(body, 4.0, keel, was.inertia));
    OK(lr_body_get_properties(body, &is));
    HOLDS(is.mass == 4.0 && is.centre_of_buoyancy.y == 0.02);
    FAILS(lr_body_get_properties(NULL, &is), LR_STATUS_POINTER, "`body` is NULL");
    FAILS(lr_body_get_properties(body, NULL), LR_STATUS_POINTER, "`out` is NULL");
    lr_body_free(body);
    lr_body_free(NULL);
}

static void steppers(const char *bake) {
    lr_body *body, *plate;
    lr_fluid air = lr_fluid_air(), water = lr_fluid_water(), none = lr_fluid_air();
    lr_settings settings = lr_settings_default();
    lr_stepper *stepper = (lr_stepper *)&faults;
    HOLDS(air.density < water.density && settings.gravity.y == -9.81);
    OK(lr_body_load(bake, &body));
    OK(lr_body_plate(0.1, 0.1, 0.001, 500.0, &plate));

    FAILS(lr_stepper_new(NULL, &air, NULL, &stepper), LR_STATUS_POINTER, "`body` is NULL");
    HOLDS(stepper == NULL);
    FAILS(lr_stepper_new(body, NULL, NULL, &stepper), LR_STATUS_POINTER, "`fluid` is NULL");
    FAILS(lr_stepper_new(body, &air, NULL, NULL), LR_STATUS_POINTER, "`out` is NULL");
    none.density = -1.0;
    FAILS(lr_stepper_new(body, &none, NULL, &stepper), LR_STATUS_SETUP, "density");
    settings.model = 99;
    FAILS(lr_stepper_new(body, &air, &settings, &stepper), LR_STATUS_ARGUMENT, "`lr_model`");
    settings.model = LR_MODEL_CONSISTENT;
    settings.turbulence = -1;
    FAILS(lr_stepper_new(body, &air, &settings, &stepper), LR_STATUS_ARGUMENT, "`lr_turbulence`");
    settings.turbulence = LR_TURBULENCE_HISTORY;
    FAILS(lr_stepper_new(plate, &air, &settings, &stepper), LR_STATUS_SETUP, "there is none");
    settings.gravity.y = NAN;
    FAILS(lr_stepper_new(body, &air, &settings, &stepper), LR_STATUS_SETUP, "gravity");
    settings = lr_settings_default();
    settings.longest_part = 0.0;
    FAILS(lr_stepper_new(body, &air, &settings, &stepper), LR_STATUS_SETUP, "longest part");
    HOLDS(stepper == NULL);

    /* The turbulence of the bake. */
    settings = lr_settings_default();
    settings.model = LR_MODEL_CONSISTENT;
    settings.turbulence = LR_TURBULENCE_HISTORY;
    OK(lr_stepper_new(body, &air, &settings, &stepper));
    lr_state state = lr_state_default();
    for (int step = 0; step < 50; ++step) OK(lr_stepper_step(stepper, &state, 0.01, NULL));
    print(&state);
    lr_stepper_free(stepper);

    OK(lr_stepper_new(body, &air, NULL, &stepper));
    lr_body_free(body);
    lr_body_free(plate);

    /* Many, each with its own noise, as one by one. */
    lr_state states[BODIES], alone[BODIES];
    lr_input inputs[BODIES];
    for (uint32_t i = 0; i < BODIES; ++i) {
        states[i] = lr_state_default();
        alone[i] = states[i];
        inputs[i] = lr_input_default();
        inputs[i].body = i;
    }
    for (int step = 0; step < 50; ++step) {
        OK(lr_stepper_step_many(stepper, states, BODIES, 0.01, step % 2 ? inputs : NULL));
        for (int i = 0; i < BODIES; ++i) OK(lr_stepper_step(stepper, &alone[i], 0.01, &inputs[i]));
    }
    for (int i = 0; i < BODIES; ++i) HOLDS(same(&states[i], &alone[i]));
    HOLDS(!same(&states[0], &states[1]));
    print(&states[BODIES - 1]);

    /* What fails leaves the state as it was. */
    const lr_state before = states[0];
    state = before;
    lr_input input = lr_input_default();
    lr_loads loads;
    double longest;
    FAILS(lr_stepper_step(NULL, &state, 0.01, NULL), LR_STATUS_POINTER, "`stepper` is NULL");
    FAILS(lr_stepper_step(stepper, NULL, 0.01, NULL), LR_STATUS_POINTER, "`state` is NULL");
    FAILS(lr_stepper_step(stepper, &state, -0.01, NULL), LR_STATUS_ARGUMENT, "time step");
    FAILS(lr_stepper_step(stepper, &state, NAN, NULL), LR_STATUS_ARGUMENT, "time step");
    input.wrench.torque.z = INFINITY;
    FAILS(lr_stepper_step(stepper, &state, 0.01, &input), LR_STATUS_ARGUMENT, "flow or wrench");
    FAILS(lr_stepper_loads(stepper, &state, &input, &loads), LR_STATUS_ARGUMENT, "flow or wrench");
    FAILS(lr_stepper_step(stepper, &state, 1e308, NULL), LR_STATUS_DIVERGED, "diverged");
    HOLDS(same(&state, &before));
    FAILS(lr_stepper_loads(NULL, &state, NULL, &loads), LR_STATUS_POINTER, "`stepper` is NULL");
    FAILS(lr_stepper_loads(stepper, NULL, NULL, &loads), LR_STATUS_POINTER, "`state` is NULL");
    FAILS(lr_stepper_loads(stepper, &state, NULL, NULL), LR_STATUS_POINTER, "`out` is NULL");
    FAILS(lr_stepper_longest_step(NULL, &state, &longest), LR_STATUS_POINTER, "`stepper` is NULL");
    FAILS(lr_stepper_longest_step(stepper, NULL, &longest), LR_STATUS_POINTER, "`state` is NULL");
    FAILS(lr_stepper_longest_step(stepper, &state, NULL), LR_STATUS_POINTER, "`out` is NULL");
    OK(lr_stepper_longest_step(stepper, &state, &longest));
    HOLDS(longest > 0.0);

    lr_state odd = before;
    odd.velocity.x = NAN;
    FAILS(lr_stepper_step(stepper, &odd, 0.01, NULL), LR_STATUS_STATE, "finite");
    FAILS(lr_stepper_loads(stepper, &odd, NULL, &loads), LR_STATUS_STATE, "finite");
    FAILS(lr_stepper_longest_step(stepper, &odd, &longest), LR_STATUS_STATE, "finite");
    odd = before;
    odd.orientation.w += 2.0;
    FAILS(lr_stepper_step(stepper, &odd, 0.01, NULL), LR_STATUS_STATE, "unit quaternion");
    FAILS(lr_stepper_loads(stepper, &odd, NULL, &loads), LR_STATUS_STATE, "unit quaternion");

    /* Of many, those before the one that fails have stepped. */
    OK(lr_stepper_step_many(stepper, NULL, 0, 0.01, NULL));
    FAILS(lr_stepper_step_many(NULL, states, BODIES, 0.01, NULL), LR_STATUS_POINTER, "`stepper` is NULL");
    FAILS(lr_stepper_step_many(stepper, NULL, BODIES, 0.01, NULL), LR_STATUS_POINTER, "`states` is NULL");
    FAILS(lr_stepper_step_many(stepper, states, (size_t)-1, 0.01, NULL), LR_STATUS_ARGUMENT, "count");
    FAILS(lr_stepper_step_many(stepper, states, BODIES, -1.0, NULL), LR_STATUS_ARGUMENT, "state 0 (from 0)");
    HOLDS(same(&states[0], &before));
    memcpy(alone, states, sizeof states);
    states[2].angular_velocity.y = INFINITY;
    FAILS(lr_stepper_step_many(stepper, states, BODIES, 0.01, NULL), LR_STATUS_STATE, "state 2 (from 0)");
    HOLDS(!same(&states[0], &alone[0]) && !same(&states[1], &alone[1]));
    HOLDS(same(&states[3], &alone[3]) && same(&states[4], &alone[4]));
    lr_stepper_free(stepper);
    lr_stepper_free(NULL);
}

static void velocities(void) {
    lr_state state = lr_state_default();
    lr_vec3 v = {1.0, 2.0, 3.0}, spin = {4.0, 5.0, 6.0}, lost = {INFINITY, 0.0, 0.0}, v_read, spin_read;
    /* A quarter turn about z: the body's x is the world's y. */
    state.orientation.z = sqrt(0.5);
    state.orientation.w = sqrt(0.5);
    OK(lr_state_set_world_velocities(&state, v, spin));
    HOLDS(fabs(state.velocity.x - 2.0) < 1e-12 && fabs(state.angular_velocity.y + 4.0) < 1e-12);
    OK(lr_state_get_world_velocities(&state, &v_read, &spin_read));
    HOLDS(fabs(v_read.x - 1.0) < 1e-12 && fabs(spin_read.z - 6.0) < 1e-12);
    OK(lr_state_get_world_velocities(&state, NULL, NULL));
    const lr_state before = state;
    FAILS(lr_state_set_world_velocities(&state, lost, spin), LR_STATUS_STATE, "finite");
    FAILS(lr_state_set_world_velocities(NULL, v, spin), LR_STATUS_POINTER, "`state` is NULL");
    FAILS(lr_state_get_world_velocities(NULL, &v, &spin), LR_STATUS_POINTER, "`state` is NULL");
    HOLDS(same(&state, &before));
    state.orientation.w = 0.0;
    FAILS(lr_state_get_world_velocities(&state, &v, &spin), LR_STATUS_STATE, "unit quaternion");
}

static void winds(void) {
    lr_vec3 o = {0.0, 0.0, 0.0}, x = {2.0, 0.0, 0.0}, y = {0.0, 3.0, 0.0}, lost = {0.0, NAN, 0.0};
    lr_vec3 here = {1.0, 2.0, 3.0};
    lr_flow flow;
    lr_wind *wind;
    OK(lr_wind_new(&wind));
    FAILS(lr_wind_new(NULL), LR_STATUS_POINTER, "`out` is NULL");
    FAILS(lr_wind_add_uniform(NULL, x), LR_STATUS_POINTER, "`wind` is NULL");
    FAILS(lr_wind_add_uniform(wind, lost), LR_STATUS_ARGUMENT, "velocity");
    FAILS(lr_wind_add_power_shear(wind, x, 0.0, 0.0, 0.2), LR_STATUS_ARGUMENT, "height");
    FAILS(lr_wind_add_power_shear(wind, x, 1.0, 0.0, -0.2), LR_STATUS_ARGUMENT, "exponent");
    FAILS(lr_wind_add_log_shear(wind, x, 1.0, NAN, 0.03), LR_STATUS_ARGUMENT, "ground");
    FAILS(lr_wind_add_log_shear(wind, x, 1.0, 0.0, 0.0), LR_STATUS_ARGUMENT, "roughness");
    FAILS(lr_wind_add_gusts(wind, -1.0, 1.0, 0.0, o, 1), LR_STATUS_ARGUMENT, "rms");
    FAILS(lr_wind_add_gusts(wind, 1.0, 1.0, 2.0, o, 1), LR_STATUS_ARGUMENT, "smallest");
    FAILS(lr_wind_add_vortex(wind, o, o, 1.0, 1.0), LR_STATUS_ARGUMENT, "axis");
    FAILS(lr_wind_add_vortex(wind, o, y, 1.0, 0.0), LR_STATUS_ARGUMENT, "core");
    FAILS(lr_wind_add_jet(wind, lost, y, 1.0, 1.0), LR_STATUS_ARGUMENT, "centre");
    FAILS(lr_wind_add_jet(wind, o, y, 1.0, -1.0), LR_STATUS_ARGUMENT, "diameter");
    OK(lr_wind_flow(wind, here, 0.5, o, &flow));
    HOLDS(flow.velocity.x == 0.0 && flow.velocity.y == 0.0 && flow.velocity.z == 0.0);

    OK(lr_wind_add_uniform(wind, x));
    OK(lr_wind_add_power_shear(wind, x, 10.0, 0.0, 0.2));
    OK(lr_wind_add_log_shear(wind, x, 10.0, 0.0, 0.03));
    OK(lr_wind_add_gusts(wind, 0.4, 2.0, 0.1, x, 5));
    OK(lr_wind_add_vortex(wind, o, y, 3.0, 0.5));
    OK(lr_wind_add_jet(wind, o, x, 4.0, 0.6));
    OK(lr_wind_flow(wind, here, 0.5, x, &flow));
    printf("%.17g %.17g %.17g %.17g %.17g %.17g %.17g\n", flow.velocity.x, flow.velocity.y, flow.velocity.z,
           flow.gradient.x.y, flow.gradient.z.x, flow.acceleration.x, flow.acceleration.z);
    FAILS(lr_wind_flow(NULL, here, 0.5, o, &flow), LR_STATUS_POINTER, "`wind` is NULL");
    FAILS(lr_wind_flow(wind, here, 0.5, o, NULL), LR_STATUS_POINTER, "`out` is NULL");
    FAILS(lr_wind_flow(wind, lost, 0.5, o, &flow), LR_STATUS_ARGUMENT, "the position");
    FAILS(lr_wind_flow(wind, here, INFINITY, o, &flow), LR_STATUS_ARGUMENT, "the time");
    FAILS(lr_wind_flow(wind, here, 0.5, lost, &flow), LR_STATUS_ARGUMENT, "the stream");
    lr_wind_free(wind);
    lr_wind_free(NULL);
}

int main(int count, char **arguments) {
    if (count != 4) {
        fprintf(stderr, "give the paths of a bake, of no file and of no bake\n");
        return EXIT_FAILURE;
    }
    HOLDS(strcmp(lr_last_error(), "") == 0);
    HOLDS(lr_abi_version() == LR_ABI_VERSION);
    printf("%s\n", lr_version());
    bodies(arguments[1], arguments[2], arguments[3]);
    steppers(arguments[1]);
    velocities();
    winds();
    return faults == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
