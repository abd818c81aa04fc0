//! Every method on the same problems, and against what is known of them.

mod convergence;
mod implicit;
mod long_step;
mod problems;
mod runge_kutta;
mod tableaus;
mod taylor;
mod work;
