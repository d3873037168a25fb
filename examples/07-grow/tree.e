communication type: pipes
executable: QuasiMC tree.qmc
turtle position: %g %g %g
turtle heading: %g %g %g
turtle left: %g %g %g
turtle up: %g %g %g
following module: on
