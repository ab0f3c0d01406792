-- RiMEA test 9: half the exits, about twice the time. Known: 500 people at a door clog it in social force and
-- collision-free speed (docs/pedestrians.md), so that there is no time to compare, or none within the band.
SELECT model, scenario || ': everybody out after, s', value, NULL, NULL, 0
FROM measured WHERE metric = 'evacuation_time' ORDER BY model DESC, value;
SELECT two.model, 'time by two exits over that by four', two.value / four.value, 1.6, 2.4, 0
FROM measured AS two JOIN measured AS four USING (model, repetition, metric)
WHERE metric = 'evacuation_time' AND two.scenario = 'two_exits' AND four.scenario = 'four_exits'
ORDER BY two.model DESC;
