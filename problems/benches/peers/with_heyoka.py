"""heyoka on the scenes of the bench `peers`, one line of JSON in, one out.

    {"scene": "1 mass on shell", "tolerance": 1e-9}  ->  {"found": [...], "run": 0}     compiled and run once
    {"run": 0}                                       ->  {"seconds": 1.4e-05}            run again

heyoka derives the equations of Lagrangians without constraints. The modes with constraints are reduced by hand, their ends are
terminal events, and this script switches. Angles are measured from the upward vertical; what is found stands in the order of
`references.rs`.
"""

import json
import math
import sys
import time

import heyoka as hy
import numpy as np

G = 9.81
theta, turn, r, radial, phi, spin = hy.make_vars("theta", "turn", "r", "radial", "phi", "spin")
cos, sin = hy.cos, hy.sin
falling = hy.event_direction.negative


def integrator(system, tolerance, *ends):
    """An adaptive integrator that ends where one of the functions falls through zero."""
    events = [hy.t_event(end, direction=falling) for end in ends]
    state = [1.0] * len(system)
    return hy.taylor_adaptive(system, state, tol=tolerance, t_events=events)


def follow(integrator, start, state):
    """Runs from a state to the first event; the time and the state there."""
    integrator.time = start
    integrator.state[:] = state
    integrator.reset_cooldowns()
    integrator.propagate_until(20.0)
    return integrator.time, integrator.state


def end_of(integrator, start, until):
    """What ends at a time."""
    start = np.array(start)

    def run():
        integrator.time = 0.0
        integrator.state[:] = start
        integrator.propagate_until(until)
        return list(integrator.state)

    return run


def flight(tolerance, floor):
    """A mass in free flight to the height -floor."""
    kinetic = 0.5 * (radial**2 + r**2 * turn**2)
    system = hy.lagrangian(kinetic - G * r * cos(theta), [r, theta], [radial, turn])
    return integrator(system, tolerance, r * cos(theta) + floor)


def cartesian(r, theta, radial, turn):
    """x and the velocities along both axes."""
    across = r * turn
    return [
        r * math.sin(theta),
        radial * math.sin(theta) + across * math.cos(theta),
        radial * math.cos(theta) - across * math.sin(theta),
    ]


def mass_on_shell(tolerance):
    system = hy.lagrangian(0.5 * turn**2 - G * cos(theta), [theta], [turn])
    slide = integrator(system, tolerance, G * cos(theta) - turn**2)
    fly = flight(tolerance, 1.0)

    def run():
        lost, (angle, rate) = follow(slide, 0.0, (0.01, 0.0))
        leaves = [lost, angle, rate]
        end, state = follow(fly, lost, (1.0, angle, 0.0, rate))
        return leaves + [end] + cartesian(*state)

    return run


RADIUS, DISTANCE = 0.2, 1.2


def rolling(tolerance, end):
    kinetic = 0.7 * DISTANCE**2 * turn**2
    system = hy.lagrangian(kinetic - G * DISTANCE * cos(theta), [theta], [turn])
    return integrator(system, tolerance, *end)


def spinning_flight(tolerance):
    kinetic = 0.5 * (radial**2 + r**2 * turn**2)
    system = hy.lagrangian(kinetic - G * r * cos(theta), [r, theta], [radial, turn])
    system = system + [(phi, spin), (spin, hy.expression(0.0))]
    return integrator(system, tolerance, r * cos(theta) + 1.0)


def rolling_sphere(tolerance):
    roll = rolling(tolerance, [G * cos(theta) - DISTANCE * turn**2])
    fly = spinning_flight(tolerance)

    def run():
        lost, (angle, rate) = follow(roll, 0.0, (0.01, 0.0))
        leaves = [lost, angle, rate]
        ratio = DISTANCE / RADIUS
        end, state = follow(
            fly, lost, (DISTANCE, angle, 0.0, rate, ratio * (angle - 0.01), ratio * rate)
        )
        return leaves + [end] + cartesian(*state[:2], *state[2:4]) + list(state[4:])

    return run


def slipping_sphere(tolerance, static=0.4, kinetic=0.3):
    normal = G * cos(theta) - DISTANCE * turn**2
    needed = 2.0 / 7.0 * G * sin(theta)
    roll = rolling(tolerance, [static * normal - needed, static * normal + needed])
    system = [
        (theta, turn),
        (turn, (G * sin(theta) - kinetic * normal) / DISTANCE),
        (phi, spin),
        (spin, kinetic * normal * RADIUS / (0.4 * RADIUS**2)),
    ]
    slip = integrator(system, tolerance, normal, DISTANCE * turn - RADIUS * spin)
    fly = spinning_flight(tolerance)

    def run():
        slips, (angle, rate) = follow(roll, 0.0, (0.01, 0.0))
        first = [slips, angle, rate]
        ratio = DISTANCE / RADIUS
        lost, state = follow(slip, slips, (angle, rate, ratio * (angle - 0.01), ratio * rate))
        angle, rate, turned, turning = state
        second = [lost, angle, rate]
        end, state = follow(fly, lost, (DISTANCE, angle, 0.0, rate, turned, turning))
        return first + second + [end] + cartesian(*state[:2], *state[2:4]) + list(state[4:])

    return run


def mass_on_wheel(tolerance, wheel=1.0, mass=0.2, radius=0.5, static=0.6, kinetic=0.5):
    inertia = wheel * radius**2 / 2
    s, c = sin(theta), cos(theta)
    whole = wheel * radius**2 + inertia + 2 * mass * radius**2 * (1.0 + c)
    change = (mass * G * radius * s + mass * radius**2 * s * turn**2) / whole
    normal = mass * (G * c - radius * turn**2 + radius * change * s)
    needed = mass * (radius * change * (1.0 + c) - G * s)
    stuck = integrator(
        [(theta, turn), (turn, change)],
        tolerance,
        static * normal - needed,
        static * normal + needed,
    )
    # The mass slips forward: friction acts backward.
    along = -kinetic * (1.0 + c)
    centrifugal = mass * (G * c - radius * turn**2)
    roll = -radius * centrifugal * (along + s)
    roll = roll / (inertia + wheel * radius**2 + mass * radius**2 * s * (s + along))
    pressed = centrifugal + mass * radius * s * roll
    slide = (-kinetic * pressed / mass + G * s) / radius - roll * c
    slip = integrator(
        [(theta, turn), (turn, slide), (phi, spin), (spin, roll)],
        tolerance,
        pressed,
        turn - spin,
    )
    place, speed = hy.make_vars("place", "speed")
    across = speed + radial * s + r * turn * c
    upward = radial * c - r * turn * s
    energy = 0.5 * (wheel + inertia / radius**2) * speed**2
    energy = energy + 0.5 * mass * (across**2 + upward**2) - mass * G * r * c
    system = hy.lagrangian(energy, [place, r, theta], [speed, radial, turn])
    fly = integrator(system, tolerance, r * c + radius, r - radius)

    def run():
        slips, (angle, rate) = follow(stuck, 0.0, (0.05, 0.0))
        first = [slips, angle, rate]
        lost, state = follow(slip, slips, (angle, rate, angle - 0.05, rate))
        angle, rate, turned, turning = state
        second = [lost, angle, rate, turning]
        start = (radius * turned, radius, angle, radius * turning, 0.0, rate)
        end, (wheel_at, r_, angle, wheel_speed, radial_, rate) = follow(fly, lost, start)
        x, across, upward = cartesian(r_, angle, radial_, rate)
        last = [end, wheel_at + x, wheel_at, wheel_speed + across, upward, wheel_speed]
        return first + second + last

    return run


def links(tolerance, angles, until):
    """A chain of equal links with a mass at each end; here angles are measured from the downward vertical."""
    count = len(angles)
    places = [hy.make_vars(f"q{i}") for i in range(count)]
    rates = [hy.make_vars(f"v{i}") for i in range(count)]
    terms, across, upward, height = [], 0.0, 0.0, 0.0
    for place, rate in zip(places, rates):
        across = across + cos(place) * rate
        upward = upward + sin(place) * rate
        height = height - cos(place)
        terms.append(0.5 * (across**2 + upward**2) - G * height)
    system = hy.lagrangian(hy.sum(terms), places, rates)
    return end_of(integrator(system, tolerance), list(angles) + [0.0] * count, until)


def double_pendulum(tolerance):
    return links(tolerance, [2.0, 2.5], 5.0)


def chain(tolerance):
    return links(tolerance, [0.5, 0.7, 0.9, 1.1, 1.3], 2.0)


def cartesian_pendulum(tolerance):
    x, y, vx, vy = hy.make_vars("x", "y", "vx", "vy")
    force = (vx**2 + vy**2 - G * y) / (x**2 + y**2)
    system = [(x, vx), (y, vy), (vx, -force * x), (vy, -force * y - G)]
    return end_of(integrator(system, tolerance), [1.0, 0.0, 0.0, 0.0], 100.0)


def kepler(tolerance, eccentricity=0.9):
    x, y, vx, vy = hy.make_vars("x", "y", "vx", "vy")
    energy = 0.5 * (vx**2 + vy**2) + (x**2 + y**2) ** -0.5
    system = hy.lagrangian(energy, [x, y], [vx, vy])
    speed = math.sqrt((1 + eccentricity) / (1 - eccentricity))
    start = [1 - eccentricity, 0.0, 0.0, speed]
    return end_of(integrator(system, tolerance), start, 200 * math.pi)


def spring_pendulum(tolerance):
    energy = 0.5 * (radial**2 + r**2 * turn**2) + G * r * cos(theta) - 0.5e6 * (r - 1.0) ** 2
    system = hy.lagrangian(energy, [r, theta], [radial, turn])
    return end_of(integrator(system, tolerance), [1.0, 1.0, 0.0, 0.0], 10.0)


SCENES = {
    "1 mass on shell": mass_on_shell,
    "2 rolling sphere": rolling_sphere,
    "3 sphere that rolls, then slips": slipping_sphere,
    "4 mass on wheel": mass_on_wheel,
    "double pendulum, 5 s": double_pendulum,
    "chain of 5 links, 2 s": chain,
    "Cartesian pendulum, 100 s": cartesian_pendulum,
    "Kepler e = 0.9, 100 orbits": kepler,
    "stiff spring pendulum, 10 s": spring_pendulum,
}


def main():
    runs = []
    for line in sys.stdin:
        asked = json.loads(line)
        if "scene" in asked:
            run = SCENES[asked["scene"]](asked["tolerance"])
            answer = {"found": [float(x) for x in run()], "run": len(runs)}
            runs.append(run)
        else:
            begin = time.perf_counter()
            runs[asked["run"]]()
            answer = {"seconds": time.perf_counter() - begin}
        print(json.dumps(answer), flush=True)


main()
