/* Times Heun steps of the rhs(t, q, v) above it: prints the median of ns per step and
   the sum of the last state. */
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define STEPS 600
#define REPETITIONS 21

static void accelerations(double t, const double *q, const double *v, double *a)
{
    static double w[WORK];
    const double *arguments[] = {&t, q, v};
    double *results[] = {a};
    rhs(arguments, results, 0, w, 0);
}

static double run(void)
{
    double q[N], v[N], here[N], there[N], predicted_q[N], predicted_v[N], sum = 0;
    for (int i = 0; i < N; i++) { q[i] = q0[i]; v[i] = v0[i]; }
    for (int k = 0; k < STEPS; k++) {
        accelerations(k * H, q, v, here);
        for (int i = 0; i < N; i++) { predicted_q[i] = q[i] + H * v[i]; predicted_v[i] = v[i] + H * here[i]; }
        accelerations((k + 1) * H, predicted_q, predicted_v, there);
        for (int i = 0; i < N; i++) {
            q[i] += 0.5 * H * (v[i] + predicted_v[i]);
            v[i] += 0.5 * H * (here[i] + there[i]);
        }
    }
    for (int i = 0; i < N; i++) sum += q[i] + v[i];
    return sum;
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

int main(void)
{
    double times[REPETITIONS], sum = 0;
    for (int k = 0; k < REPETITIONS; k++) {
        struct timespec start, end;
        clock_gettime(CLOCK_MONOTONIC, &start);
        sum = run();
        clock_gettime(CLOCK_MONOTONIC, &end);
        times[k] = ((end.tv_sec - start.tv_sec) * 1e9 + (end.tv_nsec - start.tv_nsec)) / STEPS;
    }
    qsort(times, REPETITIONS, sizeof *times, compare);
    printf("step %.3f %.12g\n", times[REPETITIONS / 2], sum);
    return 0;
}
