-- RiMEA test 6: everybody passes the corner; judge.sh checks overlaps with walls in every test.
SELECT model, 'people who did not get round', max(value), 0, 0, 1
FROM measured WHERE metric = 'people_left_behind' GROUP BY model ORDER BY model DESC;
