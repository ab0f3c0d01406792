-- RiMEA test 12: a jam before the corridor, and none in the room behind it, while people arrive at the corridor. In a
-- jam, the density exceeds that of the greatest flow (1.75 people/m2 by Weidmann's curve) and the speed is below half
-- of the free speed; without a jam, the density is lower and the speed higher.
SELECT model, 'density before the corridor, people/m2', avg(value), 1.75, NULL, 1
FROM measured WHERE metric = 'density_before' GROUP BY model ORDER BY model DESC;
SELECT model, 'speed before the corridor, m/s', avg(value), 0, 0.67, 1
FROM measured WHERE metric = 'speed_before' GROUP BY model ORDER BY model DESC;
SELECT model, 'density in room 2, people/m2', avg(value), 0, 1.75, 1
FROM measured WHERE metric = 'density_behind' GROUP BY model ORDER BY model DESC;
SELECT model, 'speed in room 2, m/s', avg(value), 0.67, NULL, 1
FROM measured WHERE metric = 'speed_behind' GROUP BY model ORDER BY model DESC;
SELECT model, 'density before the exit, people/m2', avg(value), 0, 1.75, 1
FROM measured WHERE metric = 'density_at_exit' GROUP BY model ORDER BY model DESC;
SELECT model, 'speed before the exit, m/s', avg(value), NULL, NULL, 0
FROM measured WHERE metric = 'speed_at_exit' GROUP BY model ORDER BY model DESC;
SELECT model, 'flow through the corridor, 1/(m s)', avg(value), NULL, NULL, 0
FROM measured WHERE metric = 'bottleneck_flow' GROUP BY model ORDER BY model DESC;
SELECT model, 'people who did not get out', max(value), 0, 0, 1
FROM measured WHERE metric = 'people_left_behind' GROUP BY model ORDER BY model DESC;
