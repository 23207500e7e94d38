// Boost odeint: its symplectic steppers, and its adaptive steppers of high order, with the forces written by hand.
#define restrict __restrict
#include "../c/forces.h"

#include <array>
#include <boost/numeric/odeint.hpp>
#include <boost/numeric/odeint/stepper/symplectic_rkn_sb3a_m4_mclachlan.hpp>
#include <string>

using namespace boost::numeric::odeint;

template <class Stepper, class System, class State>
double timed_steps(System system, State &state, double h, long steps)
{
    double start = seconds();
    integrate_n_steps(Stepper(), system, state, 0.0, h, steps);
    return seconds() - start;
}

template <class Stepper, class System, class State>
double timed_adaptive(System system, State &state, double tolerance, double until)
{
    double start = seconds();
    integrate_adaptive(make_controlled(tolerance, tolerance, Stepper()), system, state, 0.0, until, until / 1e4);
    return seconds() - start;
}

template <size_t D, void (*gradient)(const initial *, const double *, double *)>
struct problem {
    using half = std::array<double, D>;
    using whole = std::array<double, 2 * D>;

    const initial &s;
    half q, p;

    explicit problem(const initial &s) : s(s)
    {
        std::copy_n(s.q, D, q.begin());
        std::copy_n(s.p, D, p.begin());
    }

    // a symplectic stepper, for dq/dt = p/m and dp/dt = −U_q
    template <class Stepper>
    double symplectic(double h, long steps)
    {
        auto velocity = [this](const half &p, half &dq) { for (size_t d = 0; d < D; d++) dq[d] = s.inverse_mass[d] * p[d]; };
        auto force = [this](const half &q, half &dp) {
            gradient(&s, q.data(), dp.data());
            for (double &x : dp) x = -x;
        };
        auto state = std::make_pair(boost::ref(q), boost::ref(p));
        return timed_steps<Stepper>(std::make_pair(velocity, force), state, h, steps);
    }

    // velocity Verlet wants velocities and accelerations
    double verlet(double h, long steps)
    {
        half v;
        for (size_t d = 0; d < D; d++) v[d] = s.inverse_mass[d] * p[d];
        auto acceleration = [this](const half &q, const half &, half &a, double) {
            gradient(&s, q.data(), a.data());
            for (size_t d = 0; d < D; d++) a[d] *= -s.inverse_mass[d];
        };
        auto state = std::make_pair(boost::ref(q), boost::ref(v));
        double time = timed_steps<velocity_verlet<half>>(acceleration, state, h, steps);
        for (size_t d = 0; d < D; d++) p[d] = s.mass[d] * v[d];
        return time;
    }

    template <class Stepper>
    double adaptive(double tolerance, double until)
    {
        whole y;
        std::copy(q.begin(), q.end(), y.begin());
        for (size_t d = 0; d < D; d++) y[D + d] = s.inverse_mass[d] * p[d];
        auto right_side = [this](const whole &y, whole &dy, double) {
            std::copy(y.begin() + D, y.end(), dy.begin());
            gradient(&s, y.data(), dy.data() + D);
            for (size_t d = 0; d < D; d++) dy[D + d] *= -s.inverse_mass[d];
        };
        double time = timed_adaptive<Stepper>(right_side, y, tolerance, until);
        std::copy_n(y.begin(), D, q.begin());
        for (size_t d = 0; d < D; d++) p[d] = s.mass[d] * y[D + d];
        return time;
    }

    double part(const request &r)
    {
        std::string method = r.method;
        double until = r.until / r.samples, h = r.until / atol(r.parameter);
        long steps = atol(r.parameter) / r.samples;
        if (method == "velocity_verlet") return verlet(h, steps);
        if (method == "symplectic_rkn_sb3a_mclachlan") return symplectic<symplectic_rkn_sb3a_mclachlan<half>>(h, steps);
        if (method == "symplectic_rkn_sb3a_m4_mclachlan") return symplectic<symplectic_rkn_sb3a_m4_mclachlan<half>>(h, steps);
        if (method == "runge_kutta_fehlberg78") return adaptive<runge_kutta_fehlberg78<whole>>(atof(r.parameter), until);
        ::fail("no such method", r.method);
        return 0;
    }

    void answer(const request &r)
    {
        double time = 0;
        for (int sample = 0; sample < r.samples; sample++) {
            time += part(r);
            report_state(D, q.data(), p.data());
        }
        print_answer(time);
    }
};

int main()
{
    static initial s;
    request r;
    while (next_request(&r)) {
        read_initial(r.problem, &s);
        std::string name = r.problem;
        if (name == "kepler") problem<KEPLER_D, kepler_gradient>(s).answer(r);
        else if (name == "henon-heiles") problem<HENON_HEILES_D, henon_heiles_gradient>(s).answer(r);
        else if (name == "outer-solar-system") problem<OUTER_D, outer_gradient>(s).answer(r);
        else if (name == "fput-alpha") problem<FPUT_D, fput_gradient>(s).answer(r);
        else if (name == "argon") problem<ARGON_D, argon_gradient>(s).answer(r);
        else ::fail("no such problem", r.problem);
    }
}
