/* A control loop around an exported mechanism, as firmware would run it: a PI controller keeps the crank of a
   slider-crank at its speed against the pulsating inertia of rod and slider.

   mbs export c slider-crank-free --out crank
   cc -std=c99 -O2 -ffp-contract=off -Icrank embed.c crank/slider_crank_free.c -lm -o embed && ./embed

   It prints time, speed and torque in SI units. Nothing here allocates. */
#include "slider_crank_free.h"

#include <stdio.h>

/* Controller and plant run at 2 kHz. */
static const double step = 0.5e-3;
/* 250 rpm */
static const double target = 250.0 * 3.14159265358979323846 / 30.0;

/* A proportional-integral controller with a limited output. */
struct speed_controller {
    double proportional, integral, limit, sum;
};

/* The torque for a speed error in rad/s; the sum stops at the limit. */
static double torque(struct speed_controller *controller, double error)
{
    const double sum = controller->sum + error * step;
    const double wanted = controller->proportional * error + controller->integral * sum;
    if (wanted < controller->limit && wanted > -controller->limit) {
        controller->sum = sum;
    }
    return wanted > controller->limit ? controller->limit : wanted < -controller->limit ? -controller->limit : wanted;
}

int main(void)
{
    struct speed_controller controller = {4.0, 40.0, 20.0, 0.0};
    struct slider_crank_free_parameters parameters;
    struct slider_crank_free mechanism;
    struct slider_crank_free_run plant;

    slider_crank_free_default_parameters(&parameters);
    int code = slider_crank_free_init(&mechanism, &parameters);
    if (code == SLIDER_CRANK_FREE_OK) {
        code = slider_crank_free_start(&plant, &mechanism, step);
    }
    for (int tick = 0; code == SLIDER_CRANK_FREE_OK && tick <= 2000; tick++) {
        const double speed = plant.state.v.theta1;
        plant.inputs.crank_torque = torque(&controller, target - speed);
        if (tick % 200 == 0) {
            printf("%.17g %.17g %.17g\n", plant.state.t, speed, plant.inputs.crank_torque);
        }
        code = slider_crank_free_step(&plant);
    }
    if (code != SLIDER_CRANK_FREE_OK) {
        fprintf(stderr, "%s: %s\n", slider_crank_free_words(code), slider_crank_free_where(&plant, code));
    }
    return code;
}
