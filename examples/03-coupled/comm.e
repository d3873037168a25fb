communication type: pipes
executable: QuasiMC light.qmc
turtle position: %f %f %f
turtle heading: %f %f %f
turtle left: %f %f %f
turtle up: %f %f %f
following module: yes
