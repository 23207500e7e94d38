‹provenance›
//
// A scheme for TSBASICSYMPLECTIC of PETSc, for H = T(p) + U(q):
//
//     ‹identifier›_register();
//     TSSetType(ts, TSBASICSYMPLECTIC);
//     TSBasicSymplecticSetType(ts, "‹name›"); // or -ts_basicsymplectic_type ‹name›
//
// The split "momentum" has the right-hand side -U_q(q), the split "position" T_p(p).
// PETSc evaluates the force for each kick; that of the last is not kept for the first of the next step.
// This file has its own test: mpicc -DSELF_TEST -x c ‹identifier›.h $(pkg-config --cflags --libs petsc) -lm && ./a.out
#ifndef SHADOWSTEP_‹IDENTIFIER›_PETSC_H
#define SHADOWSTEP_‹IDENTIFIER›_PETSC_H

#include <petscts.h>

// Once, after PetscInitialize.
static inline PetscErrorCode ‹identifier›_register(void)
{
    // p += h c times the right-hand side of "momentum", and then
    PetscReal c[] = {
        ‹kicks›
    };
    // q += h d times that of "position", stage by stage
    PetscReal d[] = {
        ‹drifts›
    };
    return TSBasicSymplecticRegister("‹name›", ‹order›, ‹stages›, c, d);
}

#ifdef SELF_TEST
// Kepler's problem with e = 3/5: the state that Shadowstep reaches, and the order. The state is q, p.
static PetscErrorCode force(TS ts, PetscReal t, Vec position, Vec slope, void *context)
{
    const PetscScalar *q;
    PetscScalar *dp;

    PetscFunctionBeginUser;
    PetscCall(VecGetArrayRead(position, &q));
    PetscCall(VecGetArray(slope, &dp));
    PetscScalar r2 = q[0] * q[0] + q[1] * q[1], r3 = r2 * PetscSqrtScalar(r2);
    for (int i = 0; i < 2; i++) dp[i] = -(q[i] / r3);
    PetscCall(VecRestoreArrayRead(position, &q));
    PetscCall(VecRestoreArray(slope, &dp));
    (void)ts, (void)t, (void)context;
    PetscFunctionReturn(0);
}

static PetscErrorCode velocity(TS ts, PetscReal t, Vec momentum, Vec slope, void *context)
{
    PetscFunctionBeginUser;
    PetscCall(VecCopy(momentum, slope));
    (void)ts, (void)t, (void)context;
    PetscFunctionReturn(0);
}

static PetscErrorCode measure(PetscReal h, PetscInt steps, const PetscReal *expected, PetscReal *error)
{
    const PetscScalar start[] = {0.4, 0.0, 0.0, 2.0}, *state;
    TS ts;
    Vec y;
    IS position, momentum;

    PetscFunctionBeginUser;
    PetscCall(VecCreateSeq(PETSC_COMM_SELF, 4, &y));
    for (PetscInt i = 0; i < 4; i++) PetscCall(VecSetValue(y, i, start[i], INSERT_VALUES));
    PetscCall(VecAssemblyBegin(y));
    PetscCall(VecAssemblyEnd(y));
    PetscCall(ISCreateStride(PETSC_COMM_SELF, 2, 0, 1, &position));
    PetscCall(ISCreateStride(PETSC_COMM_SELF, 2, 2, 1, &momentum));
    PetscCall(TSCreate(PETSC_COMM_SELF, &ts));
    PetscCall(TSSetType(ts, TSBASICSYMPLECTIC));
    PetscCall(TSBasicSymplecticSetType(ts, "‹name›"));
    PetscCall(TSRHSSplitSetIS(ts, "position", position));
    PetscCall(TSRHSSplitSetIS(ts, "momentum", momentum));
    PetscCall(TSRHSSplitSetRHSFunction(ts, "position", NULL, velocity, NULL));
    PetscCall(TSRHSSplitSetRHSFunction(ts, "momentum", NULL, force, NULL));
    PetscCall(TSSetTimeStep(ts, h));
    PetscCall(TSSetMaxSteps(ts, steps));
    PetscCall(TSSetMaxTime(ts, 2 * h * steps));
    PetscCall(TSSetExactFinalTime(ts, TS_EXACTFINALTIME_STEPOVER));
    PetscCall(TSSolve(ts, y));
    PetscCall(VecGetArrayRead(y, &state));
    *error = 0;
    for (int i = 0; i < 4; i++) *error = PetscMax(*error, PetscAbsScalar(state[i] - expected[i]));
    PetscCall(VecRestoreArrayRead(y, &state));
    PetscCall(TSDestroy(&ts));
    PetscCall(ISDestroy(&position));
    PetscCall(ISDestroy(&momentum));
    PetscCall(VecDestroy(&y));
    PetscFunctionReturn(0);
}

int main(int argc, char **argv)
{
    const PetscReal end[] = {‹end_q›, ‹end_p›};
    PetscReal distance;

    PetscCall(PetscInitialize(&argc, &argv, NULL, NULL));
    PetscCall(‹identifier›_register());
    PetscCall(measure(‹h›, ‹count›, end, &distance));
    printf("‹name›: ‹count› steps of ‹part›: ");
    if (distance == 0) puts("the bits of Shadowstep");
    else printf("%.1e from Shadowstep\n", (double)distance);
    int passed = distance < ‹tolerance›;
‹if order_shows›

    const PetscReal exact[] = {‹exact_q›, ‹exact_p›}; // at t = ‹time›
    PetscReal coarse, fine;
    PetscCall(measure(‹time›.0 / ‹coarse›, ‹coarse›, exact, &coarse));
    PetscCall(measure(‹time›.0 / ‹fine›, ‹fine›, exact, &fine));
    double order = PetscLog2Real(coarse / fine);
    printf("‹name›: order %.2f observed, ‹order› proved\n", order);
    passed = passed && order > ‹order› - 0.5;
‹end›
    if (!passed) puts("‹name›: the self-test has failed");
    PetscCall(PetscFinalize());
    return !passed;
}
#endif

#endif
