‹provenance›
//
// A table for SPRKStep of ARKODE (SUNDIALS 7.1 or later), for H = T(p) + U(q):
//
//     void *arkode = SPRKStepCreate(f1, f2, t0, y, context); // f1: p' = -U_q(q), f2: q' = T_p(p)
//     ARKodeSPRKTable table = ‹identifier›_table();
//     SPRKStepSetMethod(arkode, table);
//     ARKodeSPRKTable_Free(table); // SPRKStep has a copy
//
// SPRKStep evaluates f1 and f2 once in each of the ‹stages› stages, also where the weight is 0.
// This file has its own test: cc -DSELF_TEST -x c ‹identifier›.h -lsundials_arkode -lsundials_nvecserial
// -lsundials_core -lm && ./a.out
#ifndef SHADOWSTEP_‹IDENTIFIER›_SPRK_H
#define SHADOWSTEP_‹IDENTIFIER›_SPRK_H

#include <arkode/arkode_sprkstep.h>

// To be freed by ARKodeSPRKTable_Free.
static inline ARKodeSPRKTable ‹identifier›_table(void)
{
    // p += h ahat f1(q), and then
    const sunrealtype ahat[] = {
        ‹kicks›
    };
    // q += h a f2(p), stage by stage
    const sunrealtype a[] = {
        ‹drifts›
    };
    return ARKodeSPRKTable_Create(‹stages›, ‹order›, a, ahat);
}

#ifdef SELF_TEST
// Kepler's problem with e = 3/5: the state that Shadowstep reaches, and the order. The state is q, p.
#include <math.h>
#include <nvector/nvector_serial.h>
#include <stdio.h>

static int force(sunrealtype t, N_Vector y, N_Vector dy, void *context)
{
    const sunrealtype *q = N_VGetArrayPointer(y);
    sunrealtype *dp = N_VGetArrayPointer(dy) + 2, r2 = q[0] * q[0] + q[1] * q[1], r3 = r2 * sqrt(r2);
    for (int i = 0; i < 2; i++) dp[i] = -(q[i] / r3);
    (void)t, (void)context;
    return 0;
}

static int velocity(sunrealtype t, N_Vector y, N_Vector dy, void *context)
{
    const sunrealtype *p = N_VGetArrayPointer(y) + 2;
    sunrealtype *dq = N_VGetArrayPointer(dy);
    for (int i = 0; i < 2; i++) dq[i] = p[i];
    (void)t, (void)context;
    return 0;
}

static double error(double h, long steps, const double *expected)
{
    const double start[] = {0.4, 0.0, 0.0, 2.0};
    double largest = 0, reached;
    SUNContext context;
    SUNContext_Create(SUN_COMM_NULL, &context);
    N_Vector y = N_VNew_Serial(4, context);
    sunrealtype *state = N_VGetArrayPointer(y);
    for (int i = 0; i < 4; i++) state[i] = start[i];
    void *arkode = SPRKStepCreate(force, velocity, 0, y, context);
    ARKodeSPRKTable table = ‹identifier›_table();
    int flag = SPRKStepSetMethod(arkode, table);
    flag |= ARKodeSetFixedStep(arkode, h);
    flag |= ARKodeSetMaxNumSteps(arkode, steps + 1);
    flag |= ARKodeSetStopTime(arkode, h * steps);
    if (flag || ARKodeEvolve(arkode, h * steps, y, &reached, ARK_NORMAL) < 0) largest = INFINITY;
    for (int i = 0; i < 4; i++) largest = fmax(largest, fabs(state[i] - expected[i]));
    ARKodeSPRKTable_Free(table);
    ARKodeFree(&arkode);
    N_VDestroy(y);
    SUNContext_Free(&context);
    return largest;
}

int main(void)
{
    const double end[] = {‹end_q›, ‹end_p›};
    double distance = error(‹h›, ‹count›, end);
    printf("‹name›: ‹count› steps of ‹part›: ");
    if (distance == 0) puts("the bits of Shadowstep");
    else printf("%.1e from Shadowstep\n", distance);
    int passed = distance < ‹tolerance›;
‹if order_shows›

    const double exact[] = {‹exact_q›, ‹exact_p›}; // at t = ‹time›
    double order = log2(error(‹time›.0 / ‹coarse›, ‹coarse›, exact) / error(‹time›.0 / ‹fine›, ‹fine›, exact));
    printf("‹name›: order %.2f observed, ‹order› proved\n", order);
    passed = passed && order > ‹order› - 0.5;
‹end›
    if (!passed) puts("‹name›: the self-test has failed");
    return !passed;
}
#endif

#endif
