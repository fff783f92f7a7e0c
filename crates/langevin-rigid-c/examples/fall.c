/* A leaf falls for three seconds through gusts, while something pulls it upwards, and tells what acts on it. */

#include <stdio.h>
#include <stdlib.h>

#include "langevin_rigid.h"

static void must(lr_status status) {
    if (status != LR_STATUS_OK) {
        fprintf(stderr, "%s\n", lr_last_error());
        exit(EXIT_FAILURE);
    }
}

static void print(const char *name, lr_vec3 v) {
    /* Seventeen digits keep every bit. */
    printf("%s %.17g %.17g %.17g\n", name, v.x, v.y, v.z);
}

int main(void) {
    if (lr_abi_version() != LR_ABI_VERSION) {
        fprintf(stderr, "the library %s is not that of this header\n", lr_version());
        return EXIT_FAILURE;
    }

    /* 8 cm by 5 cm, 0.2 mm thick, 450 kg/m^3. */
    lr_body *leaf;
    must(lr_body_plate(0.08, 0.05, 0.2e-3, 450.0, &leaf));
    lr_fluid air = lr_fluid_air();
    lr_stepper *stepper;
    must(lr_stepper_new(leaf, &air, NULL, &stepper));
    lr_body_free(leaf);

    lr_wind *wind;
    lr_vec3 mean = {1.0, 0.0, 0.0};
    must(lr_wind_new(&wind));
    must(lr_wind_add_uniform(wind, mean));
    must(lr_wind_add_gusts(wind, 0.3, 0.5, 0.0, mean, 7));

    lr_state state = lr_state_default();
    lr_vec3 thrown = {0.5, 0.0, 0.0}, spin = {0.0, 0.0, 1.0};
    state.position.y = 5.0;
    must(lr_state_set_world_velocities(&state, thrown, spin));

    lr_input input = lr_input_default();
    input.seed = 1;
    input.wrench.force.y = 1e-3;
    for (int step = 1; step <= 180; ++step) {
        must(lr_wind_flow(wind, state.position, state.time, air.velocity, &input.flow));
        must(lr_stepper_step(stepper, &state, 1.0 / 60.0, &input));
        if (step % 30 == 0) {
            lr_vec3 velocity;
            must(lr_state_get_world_velocities(&state, &velocity, NULL));
            printf("time %.17g\n", state.time);
            print("position", state.position);
            print("velocity", velocity);
        }
    }

    lr_loads loads;
    must(lr_stepper_loads(stepper, &state, &input, &loads));
    print("weight", loads.weight.force);
    print("buoyancy", loads.buoyancy.force);
    print("drag", loads.drag.force);
    print("normal force", loads.normal_force.force);
    print("rotational lift", loads.rotational_lift.force);
    print("friction", loads.friction.force);
    print("fluid acceleration", loads.fluid_acceleration.force);
    print("outside", loads.outside.force);
    print("couple of the added mass", loads.added_mass.torque);
    print("lost couple", loads.lost_couple.torque);
    print("damping", loads.damping.torque);
    print("sum of the torques", loads.sum.torque);

    double longest;
    must(lr_stepper_longest_step(stepper, &state, &longest));
    printf("longest step %.17g\n", longest);

    lr_wind_free(wind);
    lr_stepper_free(stepper);
    return EXIT_SUCCESS;
}
