‹provenance›
"""
Steps of q' = T_p(p), p' = -U_q(q), where H = T(p) + U(q).

A step costs ‹cost›.

    include("‹identifier›.jl")

‹if not gradient_kicks›
    q, p = ‹module›.integrate(q, p, 1/64, 1000, q -> q)
‹end›
‹if gradient_kicks›
    q, p = ‹module›.integrate(q, p, 1/64, 1000, q -> q, (q, v) -> v)
‹end›

q and p are vectors, of StaticArrays too, which are fast where there are few coordinates, and
gradient(q) is U_q(q).
‹if gradient_kicks›
hessian_product(q, v) is U_qq(q) v.
‹end›
‹if every_kinetic›
velocity(p) is T_p(p), by default p, that of unit masses.
‹end›
‹if not every_kinetic›
velocity(p) is p/m, by default p; the order is for quadratic T only.
‹end›
‹if processed›
A trajectory begins with the pre-map and is read through the post-map.
‹end›
`julia ‹identifier›.jl` tests this file.
"""
module ‹module›

‹weights›

‹if kept_gradient›
"One step: q, p and g = U_q(q), which the next step takes over."
function step(q, p, g, h, ‹functions›, velocity = identity)
    ‹step›
    return q, p, g
end
‹end›
‹if kept_curvature›
"One step: q, p, g = U_q(q) and w = U_qq(q) v, v the velocity of g, which the next step takes over."
function step(q, p, g, w, h, ‹functions›, velocity = identity)
    ‹step›
    return q, p, g, w
end
‹end›
‹if not kept›
"One step: q and p."
function step(q, p, h, ‹functions›, velocity = identity)
    ‹step›
    return q, p
end
‹end›

‹if processed›
"The state at which the steps begin, from that of the trajectory."
function pre(q, p, h, ‹functions›, velocity = identity)
    ‹pre›
    return q, p
end

"The state of the trajectory, from that which steps have reached."
function post(q, p, h, ‹functions›, velocity = identity)
    ‹post›
    return q, p
end

‹end›
"q and p after this number of steps of size h."
function integrate(q, p, h, steps, ‹functions›, velocity = identity)
‹if processed›
    q, p = pre(q, p, h, ‹functions›, velocity)
‹end›
‹if kept›
    g = gradient(q)
‹end›
‹if kept_curvature›
    w = hessian_product(q, velocity(g))
‹end›
    for _ in 1:steps
‹if not kept›
        q, p = step(q, p, h, ‹functions›, velocity)
‹end›
‹if kept_gradient›
        q, p, g = step(q, p, g, h, ‹functions›, velocity)
‹end›
‹if kept_curvature›
        q, p, g, w = step(q, p, g, w, h, ‹functions›, velocity)
‹end›
    end
‹if processed›
    return post(q, p, h, ‹functions›, velocity)
‹end›
‹if not processed›
    return q, p
‹end›
end

"Kepler's problem with e = 3/5: the state that Shadowstep reaches, and the order."
function self_test()
    function gradient(q)
        r2 = q[1] * q[1] + q[2] * q[2]
        return q ./ (r2 * sqrt(r2))
    end
‹if gradient_kicks›
    function hessian_product(q, v)
        r2 = q[1] * q[1] + q[2] * q[2]
        s = 3 * (q[1] * v[1] + q[2] * v[2]) / r2
        return (v .- s .* q) ./ (r2 * sqrt(r2))
    end
‹end›
    function error_of(h, steps, expected)
        q, p = integrate([0.4, 0.0], [0.0, 2.0], h, steps, ‹functions›)
        return maximum(abs.(vcat(q, p) .- expected))
    end

    distance = error_of(‹h›, ‹count›, [‹end_q›, ‹end_p›])
    agreement = distance == 0 ? "the bits of Shadowstep" : "$distance from Shadowstep"
    println("‹name›: ‹count› steps of ‹part›: $agreement")
    passed = distance < ‹tolerance›
‹if order_shows›

    exact = [‹exact_q›, ‹exact_p›]  # at t = ‹time›
    order = log2(error_of(‹time› / ‹coarse›, ‹coarse›, exact) / error_of(‹time› / ‹fine›, ‹fine›, exact))
    println("‹name›: order $(round(order, digits = 2)) observed, ‹order› proved")
    passed = passed && order > ‹order› - 0.5
‹end›
    return passed
end

end

if abspath(PROGRAM_FILE) == @__FILE__
    ‹module›.self_test() || error("‹name›: the self-test has failed")
end
