-- RiMEA test 12: a jam before the corridor, none before the exit behind it. While the corridor is fed, in the 8 m2
-- before each: a jam is slower than half the free speed and denser than where the flow is greatest (1.75 people/m2 by
-- Weidmann's curve); without one people walk at more than half the free speed and stand at under half that density.
SELECT model, 'density before, people/m2', avg(value), 1.75, NULL, 1
FROM measured WHERE metric = 'density_before' GROUP BY model ORDER BY model DESC;
SELECT model, 'speed before, m/s', avg(value), 0, 0.67, 1
FROM measured WHERE metric = 'speed_before' GROUP BY model ORDER BY model DESC;
SELECT model, 'density behind, people/m2', avg(value), 0, 0.875, 1
FROM measured WHERE metric = 'density_behind' GROUP BY model ORDER BY model DESC;
SELECT model, 'speed behind, m/s', avg(value), 0.67, NULL, 1
FROM measured WHERE metric = 'speed_behind' GROUP BY model ORDER BY model DESC;
SELECT model, 'flow through the corridor, 1/(m s)', avg(value), NULL, NULL, 0
FROM measured WHERE metric = 'bottleneck_flow' GROUP BY model ORDER BY model DESC;
SELECT model, 'people who did not get out', max(value), 0, 0, model <> 'ORCA'
FROM measured WHERE metric = 'people_left_behind' GROUP BY model ORDER BY model DESC;
