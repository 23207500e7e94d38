/* SUNDIALS: the symplectic steppers SPRKStep of ARKODE, with fixed steps and the forces written by hand. */
#include <arkode/arkode_sprkstep.h>
#include <nvector/nvector_serial.h>

#include "../c/forces.h"

typedef void (*gradient_function)(const struct initial *, const double *, double *);

static struct initial s;
static gradient_function gradient;

/* The state is q, p. */
static int force(double t, N_Vector y, N_Vector dy, void *data)
{
    (void)t, (void)data;
    double *dp = N_VGetArrayPointer(dy) + s.dimension;
    gradient(&s, N_VGetArrayPointer(y), dp);
    for (int d = 0; d < s.dimension; d++) dp[d] = -dp[d];
    return 0;
}

static int velocity(double t, N_Vector y, N_Vector dy, void *data)
{
    (void)t, (void)data;
    const double *p = N_VGetArrayPointer(y) + s.dimension;
    double *dq = N_VGetArrayPointer(dy);
    for (int d = 0; d < s.dimension; d++) dq[d] = s.inverse_mass[d] * p[d];
    return 0;
}

static gradient_function gradient_of(const char *problem)
{
    if (strcmp(problem, "kepler") == 0) return kepler_gradient;
    if (strcmp(problem, "henon-heiles") == 0) return henon_heiles_gradient;
    if (strcmp(problem, "outer-solar-system") == 0) return outer_gradient;
    if (strcmp(problem, "fput-alpha") == 0) return fput_gradient;
    fail("no such problem", problem);
    return 0;
}

static void check(int flag, const char *what)
{
    if (flag < 0) fail("SUNDIALS has stopped", what);
}

int main(void)
{
    struct request r;
    SUNContext context;
    check(SUNContext_Create(SUN_COMM_NULL, &context), "context");
    while (next_request(&r)) {
        gradient = gradient_of(r.problem);
        read_initial(r.problem, &s);
        N_Vector y = N_VNew_Serial(2 * s.dimension, context);
        double *state = N_VGetArrayPointer(y), reached, time = 0;
        memcpy(state, s.q, s.dimension * sizeof(double)), memcpy(state + s.dimension, s.p, s.dimension * sizeof(double));
        void *arkode = SPRKStepCreate(force, velocity, 0, y, context);
        char method[80];
        snprintf(method, sizeof method, "ARKODE_SPRK_%s", r.method);
        check(SPRKStepSetMethodName(arkode, method), method);
        check(ARKodeSetFixedStep(arkode, r.until / atol(r.parameter)), "step");
        check(ARKodeSetMaxNumSteps(arkode, -1), "number of steps");
        for (int sample = 1; sample <= r.samples; sample++) {
            double end = r.until * sample / r.samples, start = seconds();
            check(ARKodeSetStopTime(arkode, end), "end");
            check(ARKodeEvolve(arkode, end, y, &reached, ARK_NORMAL), "evolve");
            time += seconds() - start;
            report_state(s.dimension, state, state + s.dimension);
        }
        print_answer(time);
        ARKodeFree(&arkode);
        N_VDestroy(y);
    }
}
